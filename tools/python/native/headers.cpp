// The headers of the library, for Python to read.
#include <span>
#include <string>
#include <string_view>

#include "geodisk_python.h"

namespace {

using namespace std::literals;
#include "headers.inc"

} // namespace

extern "C" const char* geodisk_python_headers(void) {
    static const std::string kHeaders = [] {
        std::string all;
        for (const NamedText& header : kTexts) {
            for (const std::string_view piece : header.text) {
                all += piece;
            }
        }
        return all;
    }();
    return kHeaders.c_str();
}
