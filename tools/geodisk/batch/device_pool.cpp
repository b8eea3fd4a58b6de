#include "geodisk/batch/device_pool.hpp"

#include <algorithm>
#include <memory>
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
        warn_of_missing_drivers({&reports[chosen.front()], 1});
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
                       const RunnerOptions& runner, std::size_t runs) {
    for (const std::string& name : devices) {
        Device& device = devices_.emplace_back();
        const auto shared = std::make_shared<SharedDevice>();
        for (std::size_t i = 0; i < runs; ++i) {
            device.free.push_back(
                &device.runs.emplace_back(DeviceOptions{name, validates}, runner, false, shared));
        }
    }
}

void DevicePool::open(ProgressLine& progress) {
    for (Device& device : devices_) {
        for (RunDevice& run : device.runs) {
            run.open(progress);
        }
    }
}

std::vector<std::string> DevicePool::names() const {
    std::vector<std::string> names;
    for (const Device& device : devices_) {
        names.push_back(device.runs.front().context().report().name);
    }
    return names;
}

DevicePool::Loan DevicePool::borrow() {
    std::unique_lock lock(mutex_);
    // The device with the fewest runs, the first of these.
    const auto best = [&] {
        return std::ranges::max_element(devices_, {}, [](const Device& device) {
            return device.is_lent_whole ? 0 : device.free.size();
        });
    };
    returned_.wait(lock, [&] {
        const auto device = best();
        return waiting_ == 0 && !device->is_lent_whole && !device->free.empty();
    });
    Device& device = *best();
    RunDevice* const run = device.free.back();
    device.free.pop_back();
    return {*this, device, *run, false};
}

DevicePool::Loan DevicePool::borrow_whole() {
    std::unique_lock lock(mutex_);
    const auto idle = [&] {
        return std::ranges::find_if(devices_, [](const Device& device) {
            return !device.is_lent_whole && device.free.size() == device.runs.size();
        });
    };
    ++waiting_;
    returned_.wait(lock, [&] { return idle() != devices_.end(); });
    --waiting_;
    Device& device = *idle();
    device.is_lent_whole = true;
    for (RunDevice& run : device.runs) {
        run.release_memory();
    }
    lock.unlock();
    returned_.notify_all(); // For who waits for another device.
    return {*this, device, device.runs.front(), true};
}

void DevicePool::give_back(Device& device, RunDevice& run, bool is_whole) {
    {
        const std::scoped_lock lock(mutex_);
        if (is_whole) {
            device.is_lent_whole = false;
        } else {
            device.free.push_back(&run);
        }
    }
    returned_.notify_all();
}

} // namespace geodisk::tools
