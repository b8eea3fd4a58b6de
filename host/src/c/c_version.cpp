#include <geodisk/geodisk.h>
#include <geodisk/status.hpp>
#include <geodisk/version.hpp>

extern "C" {

const char* geodisk_status_name(geodisk_status status) {
    return geodisk::to_string(static_cast<geodisk::Status>(status));
}

const char* geodisk_version(void) {
    return GEODISK_VERSION_STRING;
}

uint32_t geodisk_sampling_version(void) {
    return GEODISK_SAMPLING_VERSION;
}

} // extern "C"
