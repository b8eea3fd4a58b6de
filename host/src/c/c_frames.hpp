// Parts of the C API shared by the objects that record over several frames.
#pragma once

#include <vulkan/vulkan_core.h>

#include <geodisk/geodisk.h>

#include "c/c_call.hpp"
#include "support/try.hpp"

namespace geodisk::c {

/// Sets an option, unless the caller leaves it to the default by 0.
template <class Field, class Value>
void set_if_given(Field& field, Value value) {
    field = value != 0 ? static_cast<Field>(value) : field;
}

/// Takes the options that all such objects have.
template <class Options, class Given>
Options frame_options_of(const Given& given) {
    Options options;
    set_if_given(options.pool_bytes, given.pool_bytes);
    set_if_given(options.frames, given.frames);
    set_if_given(options.dispatches, given.dispatches);
    set_if_given(options.rounds, given.rounds);
    if (given.reader_stages != 0 || given.reader_access != 0) {
        options.readers = {given.reader_stages, given.reader_access};
    }
    return options;
}

/// Runs `body(*frames)` unless another call uses the object, which is called `name`.
template <class Frames, class Body>
geodisk_status with_frames(Frames* frames, const char* name, geodisk_error* error,
                           const Body& body) {
    return answer(error, [&]() -> Result<Done> {
        if (frames == nullptr) {
            return wrong("frames is NULL");
        }
        return hold(frames->is_held, name, [&]() -> Result<Done> { return body(*frames); });
    });
}

/// Records into a command buffer of the caller, and tells whether all is complete.
template <class Recorded>
Result<Done> record_frame(Recorded& recorded, void* command_buffer, int32_t* is_complete) {
    const auto done = recorded.record(static_cast<VkCommandBuffer>(command_buffer));
    GEODISK_TRY(done);
    if (is_complete != nullptr) {
        *is_complete = *done ? 1 : 0;
    }
    return Done{};
}

} // namespace geodisk::c
