#include "files/mtl_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/input_file.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Words = std::span<const std::string_view>;

/// A name may hold blanks.
std::string joined_text(Words words) {
    return words.empty()
               ? ""
               : std::string(words.front().data(), words.back().data() + words.back().size());
}

/// Returns the path of a file that another one names.
Path path_beside(const Path& file, std::string name) {
    if (name.size() > 1 && name.starts_with('"') && name.ends_with('"')) {
        name = name.substr(1, name.size() - 2);
    }
    std::ranges::replace(name, '\\', '/'); // As Windows writes them.
    return file.parent_path() / Path(name);
}

bool is_file(const Path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

/// Returns `line` up to a comment. Names of files may hold a '#', but not after a blank.
std::string_view without_remark(std::string_view line) {
    for (std::size_t at = line.find('#'); at != std::string_view::npos;
         at = line.find('#', at + 1)) {
        if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') {
            return line.substr(0, at);
        }
    }
    return line;
}

/// Number of words that follow an option of a map; those of a place or size are 1 to 3.
const std::map<std::string_view, std::size_t>& option_sizes() {
    static const std::map<std::string_view, std::size_t> kSizes{
        {"-blendu", 1}, {"-blendv", 1},  {"-bm", 1},  {"-boost", 1}, {"-cc", 1},
        {"-clamp", 1},  {"-imfchan", 1}, {"-mm", 2},  {"-o", 3},     {"-s", 3},
        {"-t", 3},      {"-texres", 1},  {"-type", 1}};
    return kSizes;
}

class MtlReader {
  public:
    MtlReader(const Path& obj, std::span<const std::optional<std::string>> names,
              std::vector<MeshWarning>& warnings)
        : obj_(obj), warnings_(warnings) {
        result_.colours.resize(names.size());
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i]) {
                wanted_.emplace(*names[i], i);
            }
        }
    }

    /// Reads the files behind `mtllib`: one whose name may hold blanks, or several.
    void read_library(const std::string& text) {
        if (const Path whole = path_beside(obj_, text); is_file(whole)) {
            read(whole);
            return;
        }
        std::vector<std::string_view> words;
        split_tokens(text, words);
        for (const std::string_view word : words) {
            const Path file = path_beside(obj_, std::string(word));
            if (!is_file(file)) {
                fail_input(obj_, "its material file " + file.string() +
                                     " is not there; correct mtllib, or add the file");
            }
            read(file);
        }
    }

    MaterialColours take() && {
        add_warning(warnings_, "ignored_map_option", ignored_, ignored_place_,
                    "option of map_Kd ignored", "options of map_Kd ignored");
        return std::move(result_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        fail_input(mtl_, "line " + std::to_string(line_) + ": " + message);
    }

    void read(const Path& file) {
        if (!known_files_.insert(file.string()).second) {
            return;
        }
        mtl_ = file;
        current_ = nullptr;
        const std::string bytes = read_text(file);
        TextLines lines(bytes);
        for (std::string_view line; lines.next(line);) {
            line_ = lines.number();
            split_tokens(without_remark(line), words_);
            if (!words_.empty()) {
                take_record(lower_case(std::string(words_[0])), Words(words_).subspan(1));
            }
        }
    }

    void take_record(const std::string& key, Words words) {
        if (key == "newmtl") {
            name_ = joined_text(words);
            const auto wanted = wanted_.find(name_);
            const bool is_new = wanted != wanted_.end() && !result_.colours[wanted->second];
            current_ = is_new ? &result_.colours[wanted->second].emplace() : nullptr;
        } else if (current_ == nullptr) {
            return; // Of a material that no face uses.
        } else if (key == "kd") {
            take_factor(words);
        } else if (key == "map_kd") {
            take_map(words);
        }
    }

    double number(std::string_view word) const {
        const std::optional<double> value = parse_real(word);
        if (!value || !std::isfinite(*value)) {
            fail(in_quotes(word) + " is not a finite number");
        }
        return *value;
    }

    void take_factor(Words words) {
        if (words.size() != 1 && words.size() != 3) {
            fail("Kd is read as three numbers, red, green and blue, or one for all");
        }
        for (std::size_t i = 0; i < 3; ++i) {
            current_->factor[i] = number(words[words.size() == 1 ? 0 : i]);
        }
    }

    void take_map(Words words) {
        current_->transform = MaterialColour{}.transform;
        current_->wrap_u = current_->wrap_v = ImageWrap::repeat;
        current_->image.reset();
        while (words.size() > 1 && option_sizes().contains(words[0])) {
            words = words.subspan(take_option(words));
        }
        if (!words.empty()) {
            current_->image = image_of(joined_text(words));
        }
    }

    /// Returns the number of words of the option that comes first. The last word is the image.
    std::size_t take_option(Words words) {
        const std::string_view option = words[0];
        std::size_t size = std::min(option_sizes().at(option), words.size() - 2);
        if (option == "-o" || option == "-s" || option == "-t") {
            std::array<double, 2> given{option == "-s" ? 1.0 : 0.0, option == "-s" ? 1.0 : 0.0};
            std::size_t count = 0;
            for (; count < size && parse_real(words[count + 1]); ++count) {
                if (count < given.size()) {
                    given[count] = number(words[count + 1]);
                }
            }
            if (count == 0) {
                fail(std::string(option) + " of map_Kd needs a number");
            }
            size = count;
            move_map(option, given);
        }
        const bool is_on = size == 1 && words[1] == "on";
        if (option == "-clamp" && is_on) {
            current_->wrap_u = current_->wrap_v = ImageWrap::clamp;
        }
        if (option == "-mm" || option == "-t" || option == "-imfchan" ||
            (option == "-cc" && is_on)) {
            ignored_place_ = ignored_++ == 0
                                 ? "material " + in_quotes(name_) + ": " + std::string(option)
                                 : ignored_place_;
        }
        return size + 1;
    }

    void move_map(std::string_view option, const std::array<double, 2>& given) {
        std::array<double, 6>& transform = current_->transform;
        if (option == "-s") {
            transform[0] = given[0];
            transform[4] = given[1];
        } else if (option == "-o") {
            transform[2] = given[0];
            transform[5] = given[1];
        }
    }

    /// Returns the index of an image, which is read the first time that a material names it.
    std::uint32_t image_of(const std::string& name) {
        const Path path = path_beside(mtl_, name);
        const auto next = static_cast<std::uint32_t>(result_.images.size());
        const auto [index, is_new] = images_.try_emplace(path.string(), next);
        if (is_new) {
            const std::string material = "material " + in_quotes(name_) + ": ";
            if (!is_file(path)) {
                fail(material + "its image " + path.string() +
                     " is not there; correct map_Kd, or add the file");
            }
            result_.images.push_back(
                {mtl_.string() + ": " + material + path.string(), read_regular_file(path)});
        }
        return index->second;
    }

    const Path& obj_;
    std::vector<MeshWarning>& warnings_;
    MaterialColours result_;
    std::map<std::string, std::size_t> wanted_; ///< Numbers of materials by name.
    std::map<std::string, std::uint32_t> images_;
    std::set<std::string> known_files_;
    Path mtl_;
    std::uint32_t line_ = 0;
    std::vector<std::string_view> words_;
    std::string name_;                  ///< Of the material that is read.
    MaterialColour* current_ = nullptr; ///< Null for one that is not wanted.
    std::uint64_t ignored_ = 0;         ///< Options.
    std::string ignored_place_;
};

} // namespace

MaterialColours read_mtl_files(const Path& obj, std::span<const std::string> libraries,
                               std::span<const std::optional<std::string>> names,
                               std::vector<MeshWarning>& warnings) {
    MtlReader reader(obj, names, warnings);
    for (const std::string& library : libraries) {
        reader.read_library(library);
    }
    return std::move(reader).take();
}

} // namespace geodisk::tools
