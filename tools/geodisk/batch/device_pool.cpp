#include "geodisk/batch/device_pool.hpp"

#include <algorithm>
#include <span>

#include <geodisk/context.hpp>

#include "files/vulkan_environment.hpp"
#include "geodisk/opened_device.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

std::vector<std::size_t> usable(std::span<const DeviceReport> reports, bool with_cpus) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        if (reports[i].usable() && (with_cpus || reports[i].type != VK_PHYSICAL_DEVICE_TYPE_CPU)) {
            found.push_back(i);
        }
    }
    return found;
}

} // namespace

std::vector<std::string> chosen_devices(const std::vector<std::string>& options) {
    std::vector<std::string> given = options;
    if (const std::string device = device_of_environment(); given.empty() && !device.empty()) {
        given.push_back(device == "all" ? device : chosen_device(""));
    }
    const std::vector<DeviceReport> reports = take_device(list_devices());
    const bool all = std::ranges::find(given, "all") != given.end();
    std::vector<std::size_t> chosen;
    if (all || given.empty()) {
        chosen = usable(reports, all);
    }
    if (chosen.empty() && (all || given.empty())) {
        chosen.push_back(take(select_device(reports, "")));
    }
    for (const std::string& name : given) {
        const std::size_t index =
            name == "all" ? chosen.front() : take(select_device(reports, name));
        if (std::ranges::find(chosen, index) == chosen.end()) {
            chosen.push_back(index);
        }
    }
    std::vector<std::string> names;
    names.reserve(chosen.size());
    for (const std::size_t index : chosen) {
        names.push_back(std::to_string(index));
    }
    return names;
}

DevicePool::DevicePool(const std::vector<std::string>& devices, bool validates,
                       const RunnerOptions& runner) {
    for (const std::string& name : devices) {
        free_.push_back(&devices_.emplace_back(DeviceOptions{name, validates}, runner));
    }
    std::ranges::reverse(free_); // The first is taken first.
}

void DevicePool::open(ProgressLine& progress) {
    for (RunDevice& device : devices_) {
        device.open(progress);
    }
}

std::vector<std::string> DevicePool::names() const {
    std::vector<std::string> names;
    for (const RunDevice& device : devices_) {
        names.push_back(device.context().report().name);
    }
    return names;
}

DevicePool::Loan DevicePool::borrow() {
    std::unique_lock lock(mutex_);
    returned_.wait(lock, [&] { return !free_.empty(); });
    RunDevice* const device = free_.back();
    free_.pop_back();
    return {*this, *device};
}

void DevicePool::give_back(RunDevice& device) {
    {
        const std::scoped_lock lock(mutex_);
        free_.push_back(&device);
    }
    returned_.notify_one();
}

} // namespace geodisk::tools
