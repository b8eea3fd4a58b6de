#include "c/c_call.hpp"
#include "files/vulkan_environment.hpp"
#include "geodisk_python.h"

using namespace geodisk;

extern "C" {

geodisk_status geodisk_explain_no_device(const char* message, char* text, size_t capacity,
                                         geodisk_error* error) {
    return c::answer(error, [&]() -> Result<Done> {
        if (message == nullptr || text == nullptr || capacity == 0) {
            return c::wrong("message or text is NULL");
        }
        c::copy_text(tools::with_driver_fault(message), text, capacity);
        return Done{};
    });
}

} // extern "C"
