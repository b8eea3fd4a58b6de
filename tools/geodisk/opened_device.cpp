#include "geodisk/opened_device.hpp"

#include <string>

#include "files/vulkan_environment.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {

Context open_device(const DeviceOptions& options, bool graphics, ProgressLine& progress) {
    progress.begin_stage("opening the device");
    ContextOptions wanted;
    wanted.device = chosen_device(options.device);
    wanted.validation = options.validate;
    wanted.graphics = graphics;
    Context context = take_device(Context::create(wanted));
    if (wanted.device.empty()) {
        progress.clear();
        warn_of_missing_drivers({&context.report(), 1});
    }
    check_interrupted();
    return context;
}

void warn_of_missing_drivers(std::span<const DeviceReport> devices) {
    for (const std::string& driver : missing_drivers(devices)) {
        print_warning(left_out_warning(driver));
    }
}

std::string chosen_device(const std::string& given) {
    std::string device = given.empty() ? device_of_environment() : given;
    if (given.empty() && !device.empty()) {
        take(select_device(take_device(list_devices()), device), kDeviceVariable);
    }
    return device;
}

void check_validation(const Context& context) {
    if (context.validation_message_count() > 0) {
        const auto messages = take(context.validation_messages());
        throw UserError(ExitCode::internal,
                        std::to_string(context.validation_message_count()) +
                            " messages of the validation layer, the first: " + messages.front());
    }
}

} // namespace geodisk::tools
