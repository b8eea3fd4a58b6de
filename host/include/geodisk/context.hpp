// Context: a Vulkan instance, device and queue of geodisk's own, for programs that have none.
//
// This is the only part of geodisk that loads the Vulkan loader, and it does so at run time: a
// program that uses it starts on machines without Vulkan and gets an Error there. It needs the
// library target geodisk::context.
// Stable.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <geodisk/device.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// How to create a Context.
struct ContextOptions {
    /// Which device to use, see `select_device`; empty for the best one.
    std::string device;
    /// Load the Khronos validation layer with synchronization validation. For development: every
    /// call becomes several times slower. Creation fails where the layer is not installed.
    bool validation = false;
    /// Called with each validation message (severity warning or higher) while `validation` is on,
    /// on the thread that made the offending Vulkan call, so possibly on several at once. It must
    /// not call Vulkan; exceptions it throws are dropped.
    std::function<void(std::string_view)> on_validation_message;
    /// Have the driver keep what Sampler::report_kernels asks it for. For development: kernels take
    /// longer to compile. Creation fails where the device cannot.
    bool pipeline_statistics = false;
    /// The queue is to draw as well. Creation fails where the device has none for graphics and
    /// compute.
    bool graphics = false;
    /// Keep compiled pipelines in a file for later processes, and take them from there. The file is
    /// in the folder `geodisk` of the user's cache folder ($XDG_CACHE_HOME or ~/.cache, on Windows
    /// %LOCALAPPDATA%, on macOS ~/Library/Caches), one per device, driver and version of geodisk.
    /// It is read at creation and written at destruction. A file that is damaged or cannot be
    /// written is ignored. GEODISK_CACHE=off in the environment turns it off.
    bool keep_pipelines = false;
};

/// Index into `reports` of the device that `device` names.
///
/// `device` is, tried in this order: empty for the best device; a device UUID in hexadecimal, with
/// or without dashes; an index into `reports`, as any number below 100; or a part of the device
/// name, upper and lower case being the same. Where several devices match, the best usable one is
/// taken: discrete before integrated, virtual and CPU devices, then the order of `reports`.
///
/// Errors: `no_device` when nothing matches, listing what there is; `device_lacks` when no match
/// is usable, with every reason; `out_of_host_memory`.
Result<std::size_t> select_device(std::span<const DeviceReport> reports,
                                  std::string_view device) noexcept;

/// Reports on every Vulkan device of this machine, usable or not, in the order of the driver.
///
/// Creates and destroys an instance. Errors: `no_device` without loader, driver or device, with a
/// hint what to install; `out_of_host_memory`.
Result<std::vector<DeviceReport>> list_devices() noexcept;

/// Owns an instance, a device with one queue for compute, and for graphics where asked for, and the
/// loaded loader library.
///
/// Movable, not copyable. A moved-from Context may only be destroyed or assigned to. Contexts are
/// independent of each other; several may exist at once. Everything created from `device()` must
/// be destroyed, and its work finished, before the Context. The member functions may be called
/// from several threads at once.
class Context {
  public:
    /// Creates a context on the chosen device.
    ///
    /// Errors: `no_device` without loader, driver or matching device; `device_lacks` when the
    /// device falls short, with every reason, or lacks what an option needs, or when the
    /// validation layer is missing; else as Vulkan fails.
    static Result<Context> create(const ContextOptions& options = {}) noexcept;

    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    /// The device, valid as long as this Context (also after moving it).
    DeviceRefs device() const noexcept;

    /// The one queue. It comes with a lock of this Context, so that several users may share it.
    QueueRef queue() const noexcept;

    /// Returns what is known about the device. It lives as long as this Context.
    const DeviceReport& report() const noexcept;

    /// Number of validation messages so far; always 0 without `ContextOptions::validation`.
    std::size_t validation_message_count() const noexcept;

    /// The first 256 validation messages, one line or more each. Errors: `out_of_host_memory`.
    Result<std::vector<std::string>> validation_messages() const noexcept;

  private:
    struct Impl;
    friend struct ContextAccess;
    explicit Context(std::unique_ptr<Impl> impl) noexcept;

    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
