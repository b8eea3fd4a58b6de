#include "report/front_end.hpp"

namespace geodisk::tools::report {
namespace {

using namespace std::literals;

#include "front_end_texts.inc"

} // namespace

bool has_front_end() {
    return true;
}

Text front_end_text(std::string_view name) {
    for (const NamedText& text : kTexts) {
        if (text.name == name) {
            return text.text;
        }
    }
    return {};
}

} // namespace geodisk::tools::report
