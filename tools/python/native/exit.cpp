#include <cstdio>
#include <cstdlib>

#include "geodisk_python.h"

#ifdef __GLIBC__
#include <unistd.h>

namespace {

void end_at_once(int status, void* /*unused*/) {
    std::fflush(nullptr);
    _exit(status);
}

} // namespace
#endif

void geodisk_skip_exit_handlers(void) {
#ifdef __GLIBC__
    on_exit(&end_at_once, nullptr); // Handlers run in the reverse order.
#endif
}
