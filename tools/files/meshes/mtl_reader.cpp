#include "files/meshes/mtl_reader.hpp"

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
#include "files/meshes/mtl_records.hpp"
#include "files/meshes/named_images.hpp"
#include "files/name_text.hpp"
#include "files/text_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

bool is_file(const Path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

class MtlReader {
  public:
    MtlReader(const Path& obj, std::span<const std::optional<std::string>> names,
              const FileScope& scope, std::vector<MeshWarning>& warnings)
        : obj_(obj), scope_(scope), warnings_(warnings) {
        result_.colours.resize(names.size());
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i]) {
                wanted_.emplace(composed_name(*names[i]), i);
            }
        }
    }

    /// Reads the files behind `mtllib`: one whose name may hold blanks, or several.
    void read_library(const std::string& text) {
        const auto is_there = [&](const std::string& name) {
            return is_file(scope_.find(obj_, name).file);
        };
        for (const std::string& name : library_names(text, is_there)) {
            read(name);
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

    void read(const std::string& name) {
        const FoundFile found = scope_.find(obj_, name);
        if (!found.refusal.empty()) {
            fail_input(obj_, "its material file " + found.refusal);
        }
        const Path& file = found.file;
        if (!is_file(file)) {
            fail_input(obj_, "its material file " + named_path(obj_, readable_name(name)).string() +
                                 " is not there; correct mtllib, or add the file");
        }
        note_name("its material file", found, warnings_);
        if (!known_files_.insert(file.string()).second) {
            return;
        }
        mtl_ = file;
        current_ = nullptr;
        const std::string bytes = read_text(file);
        MtlRecords records(bytes);
        while (records.next(words_)) {
            line_ = records.number();
            take_record(lower_case(std::string(words_[0])), Words(words_).subspan(1));
        }
    }

    void take_record(const std::string& key, Words words) {
        if (key == "newmtl") {
            name_ = readable_name(joined_text(words));
            const auto wanted = wanted_.find(composed_name(name_));
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
        current_->tiles.clear();
        while (const std::size_t size = map_option_size(words)) {
            take_option(words[0], words.subspan(1, size - 1));
            words = words.subspan(size);
        }
        if (!words.empty()) {
            images_.take(joined_text(words),
                         {mtl_, "line " + std::to_string(line_) + ": ",
                          "material " + in_quotes(name_) + ": ", "correct map_Kd, or add the file"},
                         *current_);
        }
    }

    void take_option(std::string_view option, Words values) {
        if (has_numbers(option)) {
            if (values.empty()) {
                fail(std::string(option) + " of map_Kd needs a number");
            }
            std::array<double, 2> given{option == "-s" ? 1.0 : 0.0, option == "-s" ? 1.0 : 0.0};
            for (std::size_t i = 0; i < std::min(values.size(), given.size()); ++i) {
                given[i] = number(values[i]);
            }
            move_map(option, given);
        }
        const bool is_on = values.size() == 1 && values[0] == "on";
        if (option == "-clamp" && is_on) {
            current_->wrap_u = current_->wrap_v = ImageWrap::clamp;
        }
        if (option == "-mm" || option == "-t" || option == "-imfchan" ||
            (option == "-cc" && is_on)) {
            ignored_place_ = ignored_++ == 0
                                 ? "material " + in_quotes(name_) + ": " + std::string(option)
                                 : ignored_place_;
        }
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

    const Path& obj_;
    const FileScope& scope_;
    std::vector<MeshWarning>& warnings_;
    MaterialColours result_;
    std::map<std::string, std::size_t> wanted_; ///< Numbers of materials by name.
    NamedImages images_{scope_, result_.images, warnings_};
    std::set<std::string> known_files_;
    Path mtl_;
    std::uint32_t line_ = 0;
    std::vector<std::string_view> words_;
    std::string name_;                  ///< Name of the current material.
    MaterialColour* current_ = nullptr; ///< Null for one that is not wanted.
    std::uint64_t ignored_ = 0;         ///< Options.
    std::string ignored_place_;
};

} // namespace

MaterialColours read_mtl_files(const Path& obj, std::span<const std::string> libraries,
                               std::span<const std::optional<std::string>> names,
                               const FileScope& scope, std::vector<MeshWarning>& warnings) {
    MtlReader reader(obj, names, scope, warnings);
    for (const std::string& library : libraries) {
        reader.read_library(library);
    }
    return std::move(reader).take();
}

} // namespace geodisk::tools
