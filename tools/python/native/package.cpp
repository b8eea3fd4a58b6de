// The headers of the library, for Python to read, and the end of a process after fork().
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "geodisk_python.h"

#ifdef __GLIBC__
#include <unistd.h>
#endif

namespace {

using namespace std::literals;
#include "headers.inc"

#ifdef __GLIBC__
void end_at_once(int status, void* /*unused*/) {
    std::fflush(nullptr);
    _exit(status);
}
#endif

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

void geodisk_skip_exit_handlers(void) {
#ifdef __GLIBC__
    on_exit(&end_at_once, nullptr); // Handlers run in the reverse order.
#endif
}
