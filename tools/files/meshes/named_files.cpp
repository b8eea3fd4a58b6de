#include "files/meshes/named_files.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "files/input_file.hpp"
#include "files/meshes/data_uri.hpp"
#include "files/meshes/file_scope.hpp"
#include "files/meshes/gltf_chunks.hpp"
#include "files/meshes/gltf_json.hpp"
#include "files/meshes/image_tiles.hpp"
#include "files/meshes/mtl_records.hpp"
#include "files/meshes/obj_lines.hpp"
#include "files/stream_path.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

using Names = std::vector<std::string>;

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
            for (std::string& name : uri_file_names(value)) {
                names.push_back(std::move(name));
            }
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

/// Returns the name of a file, which another one may call otherwise, in the folder of that one.
std::string name_of(const Path& file, const Path& from) {
    const std::u8string name = file.lexically_proximate(from.parent_path()).generic_u8string();
    return {name.begin(), name.end()};
}

Names names_in_gltf(const Path& path, const std::string& bytes) {
    const FileScope scope(path, true);
    std::string json = gltf_chunks(path, bytes).json;
    clean_json(path, json);
    UriCollector collector;
    nlohmann::json::sax_parse(json, &collector, nlohmann::json::input_format_t::json, false);
    Names names;
    for (const std::string& name : collector.names) {
        names.push_back(name_of(scope.find(path, name).file, path));
    }
    return names;
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
    constexpr std::size_t kMaxWords = 64;
    text = trimmed(text);
    for (std::string_view rest = text; const auto quoted = next_quoted(rest);) {
        names.emplace_back(*quoted);
    }
    std::vector<std::string_view> words;
    split_tokens(text, words);
    words.resize(std::min(words.size(), kMaxWords));
    for (const std::string_view word : words) {
        names.emplace_back(word);
        names.emplace_back(text.substr(static_cast<std::size_t>(word.data() - text.data())));
    }
}

Names names_in_obj(const Path& path, const std::string& bytes) {
    const FileScope scope(path, true);
    const auto is_there = [&](const std::string& name) {
        return !scope.find(path, name).file.empty();
    };
    Names names;
    std::vector<std::string_view> words;
    ObjLines lines(bytes);
    for (std::string_view line; lines.next(line);) {
        split_tokens(line, words);
        if (!words.empty() && words[0] == "mtllib") {
            for (const std::string& name :
                 library_names(joined_text(Words(words).subspan(1)), is_there)) {
                names.push_back(name_of(scope.find(path, name).file, path));
            }
        }
    }
    return names;
}

/// Every record may name an image: as the reader takes it, or in another way.
Names names_in_mtl(const Path& path, const std::string& bytes) {
    const FileScope scope(path, true);
    Names names;
    std::vector<std::string_view> words;
    for (MtlRecords records(bytes); records.next(words);) {
        Words rest = Words(words).subspan(1);
        add_words(joined_text(rest), names);
        while (const std::size_t size = map_option_size(rest)) {
            rest = rest.subspan(size);
        }
        const std::string name = joined_text(rest);
        names.push_back(name);
        if (lower_case(std::string(words[0])) != "map_kd") {
            continue;
        }
        names.push_back(name_of(scope.find(path, name).file, path));
        if (const auto set = tile_name(name)) {
            for (const auto& [tile, file] : find_tiles(path, *set)) {
                names.push_back(file);
            }
        }
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

/// Returns what stands between one or three '@' in lines of USD.
Names names_in_usd(const std::string& bytes) {
    Names names;
    TextLines lines(bytes);
    for (std::string_view line; lines.next(line);) {
        for (std::size_t at = line.find('@'); at != line.npos; at = line.find('@', at)) {
            const std::string_view mark = line.substr(at).starts_with("@@@") ? "@@@" : "@";
            const std::size_t begin = at + mark.size(), end = line.find(mark, begin);
            if (end == line.npos) {
                break;
            }
            names.emplace_back(line.substr(begin, end - begin));
            at = end + mark.size();
        }
    }
    return names;
}

Names names_in(const Path& path, const std::string& kind) {
    const std::string bytes = read_file(path);
    if (kind == ".gltf" || kind == ".glb") {
        return names_in_gltf(path, bytes);
    }
    if (kind == ".usda" || kind == ".usd") {
        return names_in_usd(bytes);
    }
    if (kind == ".obj") {
        return names_in_obj(path, bytes);
    }
    return kind == ".mtl" ? names_in_mtl(path, bytes) : names_in_ply(bytes);
}

} // namespace

std::vector<Path> files_named_in(const Path& path, const std::string& format) {
    const std::string kind = format.empty() ? lower_extension(path) : '.' + format;
    constexpr std::array<std::string_view, 7> kNaming{".gltf", ".glb",  ".obj", ".ply",
                                                      ".mtl",  ".usda", ".usd"};
    std::error_code ignored;
    if (std::ranges::find(kNaming, kind) == kNaming.end() || input_stream(path) ||
        !std::filesystem::is_regular_file(path, ignored)) {
        return {};
    }
    std::vector<Path> files;
    try {
        for (const std::string& name : names_in(path, kind)) {
            const Path file = named_path(path, name);
            if (std::filesystem::is_regular_file(file, ignored)) {
                files.push_back(file);
            }
        }
    } catch (const UserError&) { // Whoever needs the file says what is wrong.
        return {};
    }
    const std::size_t direct = files.size();
    for (std::size_t i = 0; kind == ".obj" && i < direct; ++i) {
        std::ranges::move(files_named_in(files[i], "mtl"), std::back_inserter(files));
    }
    return files;
}

} // namespace geodisk::tools
