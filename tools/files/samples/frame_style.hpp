// The style of frames, as options and headers of files spell it.
#pragma once

#include <string>
#include <string_view>

#include "geometry/frames.hpp"

namespace geodisk::tools {

/// Spelling of the style in which z turns to the normal, in headers.
inline constexpr std::string_view kUsualFrames = "yes";

/// Reads "" or kUsualFrames, or a list with commas: the axis of the model that points up, and
/// "upright" or a part of the way to the normal. Throws UserError(usage) naming the option.
FrameStyle parse_frame_style(const std::string& option, const std::string& text);

/// Returns its spelling, without the axis of the world.
std::string text_of(const FrameStyle& style);

} // namespace geodisk::tools
