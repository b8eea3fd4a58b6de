#include "files/named_files.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "files/data_uri.hpp"
#include "files/input_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

using Names = std::vector<std::string>;

/// The bytes, or none where the file is no regular one or cannot be read.
std::string bytes_of(const Path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return {};
    }
    try {
        return read_file(path);
    } catch (const UserError&) { // Whoever needs the file says what is wrong.
        return {};
    }
}

/// Collects all values of the key "uri", at any depth.
class UriCollector : public nlohmann::json_sax<nlohmann::json> {
  public:
    Names names;

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t& value) override {
        if (is_uri_ && !value.starts_with("data:")) {
            names.push_back(value);
            names.push_back(percent_decoded(value));
        }
        return true;
    }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t& value) override {
        is_uri_ = value == "uri";
        return true;
    }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

  private:
    bool is_uri_ = false;
};

/// The JSON of a glTF file, binary or not.
std::string_view json_in(std::string_view bytes) {
    constexpr std::size_t kBefore = 20; // Header of the file and of its first chunk.
    if (!bytes.starts_with("glTF") || bytes.size() < kBefore) {
        return bytes;
    }
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, sizeof size);
    return bytes.substr(kBefore, size);
}

Names names_in_gltf(const std::string& bytes) {
    UriCollector collector;
    const std::string_view json = json_in(bytes);
    nlohmann::json::sax_parse(json.begin(), json.end(), &collector,
                              nlohmann::json::input_format_t::json, false);
    return std::move(collector.names);
}

/// Takes text up to the next part in quotation marks from `rest`, and returns that part.
std::optional<std::string_view> next_quoted(std::string_view& rest) {
    const std::size_t first = rest.find('"');
    const std::size_t last = rest.find('"', first + 1);
    if (first == std::string_view::npos || last == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view quoted = rest.substr(first + 1, last - first - 1);
    rest.remove_prefix(last + 1);
    return quoted;
}

/// Names may hold blanks and stand behind options: all ends of the text, each word, and what is in
/// quotation marks.
void add_words(std::string_view text, Names& names) {
    constexpr std::size_t kMostWords = 64;
    text = trimmed(text);
    for (std::string_view rest = text; const auto quoted = next_quoted(rest);) {
        names.emplace_back(*quoted);
    }
    std::vector<std::string_view> words;
    split_tokens(text, words);
    words.resize(std::min(words.size(), kMostWords));
    for (const std::string_view word : words) {
        names.emplace_back(word);
        names.emplace_back(text.substr(static_cast<std::size_t>(word.data() - text.data())));
    }
}

Names names_in_obj(const std::string& bytes) {
    constexpr std::string_view kKey = "mtllib";
    Names names;
    for (std::size_t at = 0; (at = bytes.find(kKey, at)) != std::string::npos;) {
        at += kKey.size();
        const std::size_t end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
        add_words(std::string_view(bytes).substr(at, end - at), names);
    }
    return names;
}

/// Every name of a line of a material may be that of a texture.
Names names_in_mtl(const std::string& bytes) {
    Names names;
    TextLines lines(bytes);
    for (std::string_view line; lines.next(line);) {
        line = trimmed(line);
        add_words(line.substr(std::min(line.find_first_of(" \t"), line.size())), names);
    }
    return names;
}

Names names_in_ply(const std::string& bytes) {
    Names names;
    TextLines lines(bytes);
    for (std::string_view line; lines.next(line) && !line.starts_with("end_header");) {
        if (lower_case(std::string(line)).find("texture") != std::string::npos) {
            add_words(line, names);
        }
    }
    return names;
}

/// Those of the names that are files, seen from the folder of `path`.
std::vector<Path> existing(const Path& path, const Names& names) {
    std::vector<Path> files;
    for (std::string name : names) {
        std::ranges::replace(name, '\\', '/'); // As Windows writes them.
        const Path file = path.parent_path() / Path(name);
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored)) {
            files.push_back(file);
        }
    }
    return files;
}

} // namespace

std::vector<Path> files_named_in(const Path& path, const std::string& format) {
    const std::string kind = format.empty() ? lower_extension(path) : '.' + format;
    if (kind == ".gltf" || kind == ".glb") {
        return existing(path, names_in_gltf(bytes_of(path)));
    }
    if (kind == ".ply") {
        return existing(path, names_in_ply(bytes_of(path)));
    }
    if (kind == ".mtl") {
        return existing(path, names_in_mtl(bytes_of(path)));
    }
    if (kind != ".obj") {
        return {};
    }
    std::vector<Path> files = existing(path, names_in_obj(bytes_of(path)));
    const std::size_t materials = files.size();
    for (std::size_t i = 0; i < materials; ++i) {
        const std::vector<Path> textures = files_named_in(files[i], "mtl");
        files.insert(files.end(), textures.begin(), textures.end());
    }
    return files;
}

} // namespace geodisk::tools
