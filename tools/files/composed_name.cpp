#include <cstdlib>
#include <memory>

#include <utf8proc.h>

#include "files/name_text.hpp"

namespace geodisk::tools {
namespace {

std::string mapped(std::string_view bytes, int options) {
    const std::string text = readable_name(bytes);
    utf8proc_uint8_t* result = nullptr;
    const auto size = utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                   static_cast<utf8proc_ssize_t>(text.size()), &result,
                                   static_cast<utf8proc_option_t>(options));
    const std::unique_ptr<utf8proc_uint8_t, void (*)(void*)> owner(result, std::free);
    return size < 0
               ? text
               : std::string(reinterpret_cast<const char*>(result), static_cast<std::size_t>(size));
}

} // namespace

std::string composed_name(std::string_view bytes) {
    return mapped(bytes, UTF8PROC_STABLE | UTF8PROC_COMPOSE);
}

std::string folded_name(std::string_view bytes) {
    return mapped(bytes, UTF8PROC_STABLE | UTF8PROC_COMPOSE | UTF8PROC_CASEFOLD);
}

} // namespace geodisk::tools
