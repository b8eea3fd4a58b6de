#include "geodisk/opened_device.hpp"

#include <string>
#include <utility>

#include "files/vulkan_environment.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {

namespace {

/// Returns the device that --device, `given`, or else GEODISK_DEVICE names.
std::string named_device(const std::string& given) {
    return given.empty() ? device_of_environment() : given;
}

} // namespace

Context create_context(const DeviceOptions& options, bool graphics) {
    ContextOptions wanted;
    wanted.device = named_device(options.device);
    wanted.validation = options.validate;
    wanted.graphics = graphics;
    wanted.keep_pipelines = true;
    auto context = Context::create(wanted);
    if (!context) {
        chosen_device(options.device); // Throws if the variable is the cause.
    }
    return take_device(std::move(context));
}

void warn_of_unasked_cpu(const DeviceOptions& options, const Context& context) {
    if (named_device(options.device).empty()) {
        warn_of_missing_drivers({&context.report(), 1});
    }
}

Context open_device(const DeviceOptions& options, bool graphics, ProgressLine& progress) {
    progress.begin_stage("opening the device");
    Context context = create_context(options, graphics);
    progress.clear();
    warn_of_unasked_cpu(options, context);
    check_interrupted();
    return context;
}

void warn_of_missing_drivers(std::span<const DeviceReport> devices) {
    for (const std::string& driver : missing_drivers(devices)) {
        print_warning(left_out_warning(driver));
    }
}

std::string chosen_device(const std::string& given) {
    std::string device = named_device(given);
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
