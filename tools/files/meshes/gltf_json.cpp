#include "files/meshes/gltf_json.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kDeepest = 200;

/// Length of the character of UTF-8 that `text` begins with; 0 if it is none.
std::size_t character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned first = byte(0);
    const std::size_t size = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0u) != 0x80u) {
            return 0;
        }
    }
    const unsigned pair = first << 8 | byte(1);
    const bool is_overlong = (first == 0xe0 && pair < 0xe0a0) || (first == 0xf0 && pair < 0xf090);
    const bool is_out_of_range =
        (first == 0xed && pair > 0xed9f) || (first == 0xf4 && pair > 0xf48f);
    return is_overlong || is_out_of_range ? 0 : size;
}

/// Goes once through the text of JSON before any parser sees it.
class JsonCleaner {
  public:
    JsonCleaner(const Path& path, std::string& text) : path_(path), text_(text) {}

    /// Replaces bytes in strings that are not UTF-8 by '?', and NaN and Infinity by empty text, all
    /// in place. Throws if arrays and objects are nested too deeply.
    void clean() {
        for (at_ = 0; at_ < text_.size();) {
            const char c = text_[at_];
            if (c == '"') {
                clean_string();
                continue;
            }
            if (c == '[' || c == '{') {
                if (++depth_ > kDeepest) {
                    fail_input(path_, "is nested too deeply: more than " +
                                          std::to_string(kDeepest) +
                                          " arrays and objects in each other");
                }
            } else if (c == ']' || c == '}') {
                depth_ -= depth_ > 0 ? 1 : 0;
            } else if (c == 'N' || c == 'I' || c == '-') {
                clean_number();
            }
            ++at_;
        }
    }

  private:
    void clean_string() {
        for (++at_; at_ < text_.size() && text_[at_] != '"';) {
            if (text_[at_] == '\\') {
                at_ += 2;
                continue;
            }
            const std::size_t size = character_size(std::string_view(text_).substr(at_, 4));
            if (size == 0) {
                text_[at_] = '?';
            }
            at_ += std::max<std::size_t>(size, 1);
        }
        ++at_;
    }

    void clean_number() {
        for (const std::string_view name : {"NaN", "-NaN", "Infinity", "-Infinity"}) {
            if (std::string_view(text_).substr(at_).starts_with(name)) {
                std::string text = "\"\""; // An error where a number is needed.
                text.resize(name.size(), ' ');
                text_.replace(at_, name.size(), text);
                at_ += name.size() - 1;
                return;
            }
        }
    }

    const Path& path_;
    std::string& text_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
};

const GltfJson kNoElements = GltfJson::array();

/// Returns true for versions such as "1" and "1.0", with this digit.
bool is_major(std::string_view version, char digit) {
    return version.starts_with(digit) && (version.size() == 1 || version[1] == '.');
}

} // namespace

void clean_json(const Path& path, std::string& text) {
    JsonCleaner(path, text).clean();
}

GltfDocument::GltfDocument(const Path& path, std::string text) : path_(path) {
    clean_json(path_, text);
    try {
        root_ = GltfJson::parse(text);
    } catch (const GltfJson::exception& error) {
        fail("is not a glTF file that can be read: " + one_line(error.what()));
    }
    check_version();
}

void GltfDocument::fail(const std::string& message) const {
    fail_input(path_, message);
}

void GltfDocument::check_version() const {
    if (!root_.is_object()) {
        fail("is not a glTF file: its JSON is no object");
    }
    const GltfJson* const asset = find_object(root_, "asset", "asset");
    const std::string version = asset == nullptr ? "" : version_of(*asset);
    const GltfJson* const meshes = find(root_, "meshes");
    const bool is_old = version.empty() && meshes != nullptr && meshes->is_object();
    if (is_old || is_major(version, '1')) {
        fail("is glTF 1.0; only 2.0 is read");
    }
    if (version.empty()) {
        fail("is not a glTF file: it has no asset.version");
    }
    const std::string least = text(*asset, "minVersion", "asset");
    if (!is_major(version, '2') || (!least.empty() && least != "2.0")) {
        fail("is glTF " + one_line(least.empty() ? version : least) + "; only 2.0 is read");
    }
}

std::string GltfDocument::version_of(const GltfJson& asset) const {
    const GltfJson* const version = find(asset, "version");
    const bool is_number = version != nullptr && version->is_number();
    return is_number ? version->dump() : text(asset, "version", "asset");
}

const GltfJson* GltfDocument::find(const GltfJson& parent, const char* name) const {
    const auto found = parent.find(name);
    return found == parent.end() || found->is_null() ? nullptr : &*found;
}

void GltfDocument::fail_value(const char* name, const std::string& where,
                              const char* expected) const {
    fail(where + ": " + name + " is not " + expected);
}

std::size_t GltfDocument::count(const char* list) const {
    return array(root_, list, "the file").size();
}

const GltfJson& GltfDocument::at(const char* list, const char* name, std::uint64_t index) const {
    const GltfJson& all = array(root_, list, "the file");
    const std::string which = std::string(name) + ' ' + std::to_string(index);
    if (index >= all.size()) {
        fail(which + " is out of range");
    }
    const GltfJson& element = all[static_cast<std::size_t>(index)];
    if (!element.is_object()) {
        fail(which + " is not an object");
    }
    return element;
}

const GltfJson* GltfDocument::find_object(const GltfJson& parent, const char* name,
                                          const std::string& where) const {
    const GltfJson* const value = find(parent, name);
    if (value != nullptr && !value->is_object()) {
        fail_value(name, where, "an object");
    }
    return value;
}

const GltfJson* GltfDocument::find_extension(const GltfJson& parent, const char* name,
                                             const std::string& where) const {
    const GltfJson* const extensions = find_object(parent, "extensions", where);
    return extensions == nullptr ? nullptr : find_object(*extensions, name, where);
}

const GltfJson& GltfDocument::array(const GltfJson& parent, const char* name,
                                    const std::string& where) const {
    const GltfJson* const value = find(parent, name);
    if (value != nullptr && !value->is_array()) {
        fail_value(name, where, "an array");
    }
    return value == nullptr ? kNoElements : *value;
}

std::uint64_t GltfDocument::to_index(const GltfJson& value, const char* name,
                                     const std::string& where) const {
    if (value.is_number_unsigned()) {
        return value.get<std::uint64_t>();
    }
    constexpr double kExact = 9007199254740992; // Beyond, not all integers are doubles.
    const double number = value.is_number_float() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= kExact && number == std::floor(number))) {
        fail_value(name, where, "a whole number from 0");
    }
    return static_cast<std::uint64_t>(number);
}

std::optional<std::uint64_t> GltfDocument::find_index(const GltfJson& parent, const char* name,
                                                      const std::string& where) const {
    const GltfJson* const value = find(parent, name);
    return value == nullptr ? std::nullopt : std::optional(to_index(*value, name, where));
}

std::uint64_t GltfDocument::index(const GltfJson& parent, const char* name,
                                  const std::string& where) const {
    const std::optional<std::uint64_t> value = find_index(parent, name, where);
    if (!value) {
        fail(where + ": has no " + name);
    }
    return *value;
}

std::uint64_t GltfDocument::index_or(const GltfJson& parent, const char* name,
                                     std::uint64_t otherwise, const std::string& where) const {
    return find_index(parent, name, where).value_or(otherwise);
}

std::vector<std::uint64_t> GltfDocument::indices(const GltfJson& parent, const char* name,
                                                 const std::string& where) const {
    std::vector<std::uint64_t> result;
    for (const GltfJson& value : array(parent, name, where)) {
        result.push_back(to_index(value, name, where));
    }
    return result;
}

std::vector<double> GltfDocument::numbers(const GltfJson& parent, const char* name,
                                          std::size_t size, const std::string& where) const {
    std::vector<double> result;
    const GltfJson& all = array(parent, name, where);
    if (!all.empty() && size > 0 && all.size() != size) {
        fail(where + ": " + name + " has " + std::to_string(all.size()) + " numbers instead of " +
             std::to_string(size));
    }
    for (const GltfJson& value : all) {
        if (!value.is_number()) {
            fail_value(name, where, "an array of numbers");
        }
        result.push_back(value.get<double>());
    }
    return result;
}

double GltfDocument::number_or(const GltfJson& parent, const char* name, double otherwise,
                               const std::string& where) const {
    const GltfJson* const value = find(parent, name);
    if (value == nullptr) {
        return otherwise;
    }
    if (!value->is_number() || !std::isfinite(value->get<double>())) {
        fail_value(name, where, "a number");
    }
    return value->get<double>();
}

std::string GltfDocument::text(const GltfJson& parent, const char* name,
                               const std::string& where) const {
    const GltfJson* const value = find(parent, name);
    if (value != nullptr && !value->is_string()) {
        fail_value(name, where, "text");
    }
    return value == nullptr ? "" : value->get<std::string>();
}

bool GltfDocument::flag(const GltfJson& parent, const char* name, const std::string& where) const {
    const GltfJson* const value = find(parent, name);
    if (value != nullptr && !value->is_boolean()) {
        fail_value(name, where, "true or false");
    }
    return value != nullptr && value->get<bool>();
}

} // namespace geodisk::tools
