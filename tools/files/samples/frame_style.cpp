#include "files/samples/frame_style.hpp"

#include <optional>

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kUpright = "upright";

std::optional<double> find_part(const std::string& word) {
    const auto part = word == kUpright ? 0.0 : parse_real(word);
    return part && *part >= 0 && *part <= 1 ? part : std::nullopt;
}

/// Sets a value that no word before has set.
template <class Value>
void set_once(const std::string& option, const std::string& text, std::optional<Value>& value,
              Value given, const char* what) {
    if (value) {
        fail_usage(option + ": " + in_quotes(text) + " gives " + what + " twice");
    }
    value = given;
}

} // namespace

FrameStyle parse_frame_style(const std::string& option, const std::string& text) {
    if (text.empty() || text == kUsualFrames) {
        return {};
    }
    std::optional<Up> model;
    std::optional<double> part;
    for (const std::string& word : parts_of(text)) {
        if (const auto axis = find_up(word)) {
            set_once(option, text, model, *axis, "the axis of the model");
        } else if (const auto found = find_part(word)) {
            set_once(option, text, part, *found, "the part of the way to the normal");
        } else {
            fail_usage(
                option + ": " + in_quotes(word) +
                " is neither x, y or z for the axis of the model that points up, nor upright, "
                "nor a number from 0 to 1 for the part of the way to the normal");
        }
    }
    FrameStyle style;
    style.model = model.value_or(style.model);
    style.part = part.value_or(style.part);
    return style;
}

std::string text_of(const FrameStyle& style) {
    std::string text;
    if (style.model != Up::z) {
        text = small_letter(style.model);
    }
    if (style.has_world()) {
        text += text.empty() ? "" : ",";
        text += style.part == 0 ? std::string(kUpright) : exact_text(style.part);
    }
    return text.empty() ? std::string(kUsualFrames) : text;
}

} // namespace geodisk::tools
