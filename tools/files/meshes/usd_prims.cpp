#include "files/meshes/usd_prims.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/matrix.hpp>

#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kPrimvar = "primvars:", kIndices = ":indices",
                           kOp = "xformOp:", kInverse = "!invert!", kSamples = ".timeSamples",
                           kWhole = "int";
constexpr std::size_t kMaxDepth = 200;

template <std::size_t kCount>
bool is_one_of(std::string_view text, const std::string_view (&list)[kCount]) {
    return std::ranges::find(list, text) != std::end(list);
}

class UsdParser {
  public:
    UsdParser(const Path& path, std::string_view bytes, const WantedFields& wanted)
        : path_(path), text_(path, bytes), wanted_(wanted) {}

    UsdScene parse() && {
        text_.metadata([&](const UsdToken& key) { return read_layer_entry(key); });
        while (text_.peek().kind != UsdToken::Kind::end) {
            const UsdToken token = text_.next();
            if (!is_specifier(token)) {
                text_.fail(token.line, in_quotes(token.text) + " instead of a prim");
            }
            add_prim(token, "/", scene_.prims, 1);
        }
        return std::move(scene_);
    }

  private:
    static bool is_specifier(const UsdToken& token) {
        return token.is_word("def") || token.is_word("over") || token.is_word("class");
    }

    [[noreturn]] void refuse(std::uint32_t line, const std::string& what) const {
        text_.fail(line, what + "; bring all into one file: usdcat -f " +
                             path_.filename().string() + " -o flat.usda");
    }

    bool read_layer_entry(const UsdToken& key) {
        if (key.text == "metersPerUnit") {
            const UsdValue value = text_.value();
            scene_.metres_per_unit = value.numbers.empty() ? 0 : value.numbers[0];
            return true;
        }
        if (key.text == "upAxis") {
            const UsdValue value = text_.value();
            scene_.up = value.texts.empty() ? "" : value.texts[0];
            return true;
        }
        if (key.text == "subLayers" && text_.take('[') && !text_.take(']')) {
            refuse(key.line, "the file has sublayers, which are not read");
        }
        return key.text == "subLayers";
    }

    /// Adds the prim behind the specifier, if it is there for viewers.
    void add_prim(const UsdToken& specifier, const std::string& above, std::vector<UsdPrim>& prims,
                  std::size_t depth) {
        if (depth > kMaxDepth) {
            text_.fail(specifier.line,
                       "prims are nested more than " + std::to_string(kMaxDepth) + " deep");
        }
        UsdPrim prim;
        prim.line = specifier.line;
        if (text_.peek().kind == UsdToken::Kind::word) {
            prim.type = text_.next().text;
        }
        const UsdToken name = text_.next();
        if (name.kind != UsdToken::Kind::string) {
            text_.fail(name.line, "a prim has no name");
        }
        prim.name = name.text;
        prim.path = above + prim.name;
        bool is_active = specifier.text == "def";
        std::string composed;
        text_.metadata([&](const UsdToken& key) {
            constexpr std::string_view kComposing[] = {"references", "payload", "inherits",
                                                       "specializes"};
            if (key.text == "active") {
                const UsdValue value = text_.value();
                is_active = is_active && (value.numbers.empty() || value.numbers[0] != 0);
                return true;
            }
            if (is_one_of(key.text, kComposing) && !text_.peek().is_word("None")) {
                composed = key.text;
            }
            return false;
        });
        if (!text_.peek().is_sign('{')) {
            text_.expect('{', "the prim <" + prim.path + ">");
        }
        constexpr std::string_view kPlaceless[] = {"Material", "Shader", "NodeGraph"};
        if (!is_active || is_one_of(prim.type, kPlaceless)) {
            text_.skip_brackets();
            return;
        }
        if (!composed.empty()) {
            refuse(prim.line,
                   "prim <" + prim.path + "> has " + composed +
                       (composed == "payload" ? ", which is not read" : ", which are not read"));
        }
        text_.take('{');
        const std::string below = prim.path + '/';
        while (!text_.take('}')) {
            const UsdToken token = text_.peek();
            if (token.kind == UsdToken::Kind::end) {
                text_.fail(prim.line, "prim <" + prim.path + "> has no end");
            } else if (is_specifier(token)) {
                text_.next();
                add_prim(token, below, prim.children, depth + 1);
            } else if (token.is_word("variantSet")) {
                refuse(token.line, "prim <" + prim.path + "> has variants, which are not read");
            } else {
                read_property(prim);
            }
        }
        prims.push_back(std::move(prim));
    }

    /// Returns true for an attribute whose value matters.
    bool is_needed(const UsdPrim& prim, std::string_view name, std::string_view type) const {
        constexpr std::string_view kOfAll[] = {"xformOpOrder", "visibility", "purpose",
                                               "material:binding"};
        constexpr std::string_view kOfMeshes[] = {"points",      "faceVertexCounts",
                                                  "holeIndices", "faceVertexIndices",
                                                  "orientation", "subdivisionScheme"};
        constexpr std::string_view kOfSubsets[] = {"indices", "elementType", "familyName"};
        if (name.starts_with(kOp) || is_one_of(name, kOfAll)) {
            return true;
        }
        if (prim.type == "GeomSubset") {
            return is_one_of(name, kOfSubsets);
        }
        if (prim.type != "Mesh") {
            return false;
        }
        if (is_one_of(name, kOfMeshes)) {
            return true;
        }
        const bool is_primvar = name.starts_with(kPrimvar);
        name.remove_prefix(is_primvar ? kPrimvar.size() : 0);
        if (name == "normals") {
            return wanted_.normals;
        }
        if (!is_primvar || !wanted_.are_given()) {
            return is_primvar && wanted_.normals && name.starts_with("normals:");
        }
        if (name.ends_with(kIndices)) {
            return true;
        }
        const MeshField field = field_of_primvar(name, type);
        return wanted_.has(field.name) ||
               std::ranges::any_of(field.components,
                                   [&](const std::string& one) { return wanted_.has(one); });
    }

    /// Reads an attribute or a relationship, with its metadata.
    void read_property(UsdPrim& prim) {
        const UsdToken first = text_.peek();
        std::vector<std::string_view> words;
        while (text_.peek().kind == UsdToken::Kind::word && text_.peek().line == first.line) {
            words.push_back(text_.next().text);
            if (text_.take('[')) {
                text_.expect(']', "a type");
            }
        }
        if (words.empty()) {
            text_.fail(first.line, in_quotes(first.text.substr(0, 40)) +
                                       " is unexpected in prim <" + prim.path + ">");
        }
        UsdAttribute attribute;
        attribute.type = words.size() > 1 ? words[words.size() - 2] : "";
        std::string_view name = words.back();
        const bool is_sampled = name.ends_with(kSamples);
        name.remove_suffix(is_sampled ? kSamples.size() : 0);
        attribute.name = name;
        attribute.value.is_blocked = true;
        attribute.is_read = is_needed(prim, name, attribute.type);
        if (text_.take('=')) {
            if (!attribute.is_read) {
                text_.skip_value();
                attribute.value.is_blocked = words[0] == "rel";
            } else if (is_sampled) {
                attribute.value = first_sample();
            } else {
                attribute.value = text_.value();
            }
        }
        text_.metadata([&](const UsdToken& key) {
            if (key.text != "interpolation") {
                return false;
            }
            const UsdValue value = text_.value();
            attribute.interpolation = value.texts.empty() ? "" : value.texts[0];
            return true;
        });
        keep(prim, std::move(attribute), is_sampled);
    }

    /// Keeps an attribute. Its value without a time comes before those with.
    void keep(UsdPrim& prim, UsdAttribute&& attribute, bool is_sampled) {
        const bool is_listed = attribute.name.starts_with(kPrimvar) && prim.type == "Mesh";
        if (attribute.value.is_blocked || (!attribute.is_read && !is_listed)) {
            return;
        }
        const auto known = std::ranges::find(prim.attributes, attribute.name, &UsdAttribute::name);
        if (is_sampled && attribute.is_read && known == prim.attributes.end()) {
            ++scene_.sampled;
        }
        if (known == prim.attributes.end()) {
            prim.attributes.push_back(std::move(attribute));
        } else if (!is_sampled) {
            *known = std::move(attribute);
        }
    }

    /// Reads the first of the values in time.
    UsdValue first_sample() {
        const std::uint32_t line = text_.peek().line;
        text_.expect('{', "time samples");
        UsdValue value;
        value.is_blocked = true;
        if (text_.take('}')) {
            return value;
        }
        text_.next();
        if (const UsdToken colon = text_.next(); !colon.is_word(":")) {
            text_.fail(colon.line, in_quotes(colon.text.substr(0, 40)) +
                                       " instead of ':' after the time of a sample");
        }
        value = text_.value();
        while (!text_.take('}')) {
            const UsdToken token = text_.peek();
            if (token.kind == UsdToken::Kind::end) {
                text_.fail(line, "time samples have no end");
            }
            if (token.is_sign('[') || token.is_sign('(') || token.is_sign('{')) {
                text_.skip_brackets();
            } else {
                text_.next();
            }
        }
        return value;
    }

    const Path& path_;
    UsdText text_;
    const WantedFields& wanted_;
    UsdScene scene_;
};

glm::dmat4 translation_of(double x, double y, double z) {
    glm::dmat4 matrix(1);
    matrix[3] = {x, y, z, 1};
    return matrix;
}

glm::dmat4 scaling_of(double x, double y, double z) {
    glm::dmat4 matrix(1);
    matrix[0][0] = x;
    matrix[1][1] = y;
    matrix[2][2] = z;
    return matrix;
}

/// Returns the turn about axis 0, 1 or 2, exact for quarters.
glm::dmat4 turn_about(glm::length_t axis, double degrees) {
    const double quarters = degrees / 90;
    const bool is_whole = quarters == std::round(quarters) && std::abs(quarters) < 1e9;
    const auto exact = [&](double shift) {
        const double place = std::fmod(std::fmod(quarters + shift, 4) + 4, 4);
        return place == 0 ? 1.0 : place == 2 ? -1.0 : 0.0;
    };
    const double radians = degrees * std::numbers::pi / 180;
    const double c = is_whole ? exact(0) : std::cos(radians);
    const double s = is_whole ? exact(3) : std::sin(radians);
    const glm::length_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    glm::dmat4 matrix(1);
    matrix[a][a] = matrix[b][b] = c;
    matrix[a][b] = s; // Column a: where that axis goes.
    matrix[b][a] = -s;
    return matrix;
}

/// Returns the turn by a quaternion w x y z, of any length but 0.
std::optional<glm::dmat4> turn_by(const std::vector<double>& q) {
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length)) {
        return std::nullopt;
    }
    const double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
    glm::dmat4 matrix(1);
    matrix[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
    matrix[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
    matrix[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
    return matrix;
}

/// Returns what an operation of that kind does, with its numbers; nothing if they are no such.
std::optional<glm::dmat4> matrix_of(std::string_view kind, const std::vector<double>& n) {
    const auto axis_of = [](char c) { return static_cast<glm::length_t>(c - 'X'); };
    const auto is_axis = [](char c) { return c >= 'X' && c <= 'Z'; };
    if (!std::ranges::all_of(n, [](double x) { return std::isfinite(x); })) {
        return std::nullopt;
    }
    if (kind == "translate" && n.size() == 3) {
        return translation_of(n[0], n[1], n[2]);
    }
    if (kind == "scale" && n.size() == 3) {
        return scaling_of(n[0], n[1], n[2]);
    }
    if (kind == "orient" && n.size() == 4) {
        return turn_by(n);
    }
    if (kind == "transform" && n.size() == 16) {
        glm::dmat4 matrix; // Rows there are columns here, where points stand behind the matrix.
        for (glm::length_t i = 0; i < 4; ++i) {
            for (glm::length_t k = 0; k < 4; ++k) {
                matrix[i][k] = n[4 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)];
            }
        }
        const bool is_affine = n[3] == 0 && n[7] == 0 && n[11] == 0 && n[15] == 1;
        return is_affine ? std::optional(matrix) : std::nullopt;
    }
    constexpr std::string_view kTranslate = "translate", kScale = "scale", kRotate = "rotate";
    for (const std::string_view name : {kTranslate, kScale, kRotate}) {
        if (n.size() == 1 && kind.size() == name.size() + 1 && kind.starts_with(name) &&
            is_axis(kind.back())) {
            const glm::length_t axis = axis_of(kind.back());
            if (name == kRotate) {
                return turn_about(axis, n[0]);
            }
            std::array<double, 3> all{};
            all.fill(name == kScale ? 1 : 0);
            all[static_cast<std::size_t>(axis)] = n[0];
            return name == kScale ? scaling_of(all[0], all[1], all[2])
                                  : translation_of(all[0], all[1], all[2]);
        }
    }
    const std::string_view axes = kind.starts_with(kRotate) ? kind.substr(kRotate.size()) : "";
    std::string sorted(axes);
    std::ranges::sort(sorted);
    if (n.size() != 3 || sorted != "XYZ") {
        return std::nullopt;
    }
    glm::dmat4 matrix(1); // The first one of the name is applied first.
    for (const char axis : axes) {
        matrix = turn_about(axis_of(axis), n[static_cast<std::size_t>(axis_of(axis))]) * matrix;
    }
    return matrix;
}

} // namespace

const UsdAttribute* UsdPrim::find(std::string_view attribute) const {
    const auto found = std::ranges::find(attributes, attribute, &UsdAttribute::name);
    return found == attributes.end() ? nullptr : &*found;
}

std::string UsdPrim::text(std::string_view attribute) const {
    const UsdAttribute* const found = find(attribute);
    return found == nullptr || found->value.texts.empty() ? "" : found->value.texts[0];
}

MeshField field_of_primvar(std::string_view name, std::string_view type) {
    constexpr std::string_view kTexts[] = {"string", "token", "asset", "rel", "timecode"};
    std::size_t components = 1;
    const auto digit = std::ranges::find_if(
        type, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
    if (is_one_of(type, kTexts)) {
        components = 0;
    } else if (type.starts_with("matrix") && digit != type.end()) {
        const auto side = static_cast<std::size_t>(*digit - '0');
        components = side * side;
    } else if (type.starts_with("quat")) {
        components = 4;
    } else if (digit != type.end() && !type.starts_with("int64") && !type.starts_with("uint64")) {
        components = static_cast<std::size_t>(*digit - '0');
    }
    if (name == "displayColor" && components == 3) {
        MeshField field = make_colours(MeshField::Of::corners, 3);
        field.is_light = true;
        return field;
    }
    if ((name == "st" || name == "UVMap") && components == 2) {
        return make_uvs();
    }
    MeshField field = make_field(name, MeshField::Of::corners, components);
    field.is_whole = type.starts_with(kWhole) || type.starts_with("uint") ||
                     type.starts_with("uchar") || type.starts_with("bool");
    return field;
}

UsdScene parse_usd(const Path& path, std::string_view text, const WantedFields& wanted) {
    return UsdParser(path, text, wanted).parse();
}

glm::dmat4 usd_transform(const UsdText& text, const UsdPrim& prim, bool& is_reset) {
    is_reset = false;
    glm::dmat4 matrix(1);
    const UsdAttribute* const order = prim.find("xformOpOrder");
    if (order == nullptr) {
        return matrix;
    }
    for (const std::string& entry : order->value.texts) {
        if (entry == "!resetXformStack!") {
            is_reset = true;
            matrix = glm::dmat4(1);
            continue;
        }
        const bool is_inverse = entry.starts_with(kInverse);
        const std::string_view name =
            std::string_view(entry).substr(is_inverse ? kInverse.size() : 0);
        const UsdAttribute* const operation = prim.find(name);
        if (operation == nullptr || !name.starts_with(kOp)) {
            text.fail(order->value.line, "prim <" + prim.path + "> has no value of " +
                                             in_quotes(name) + ", which xformOpOrder names");
        }
        std::string_view kind = name.substr(kOp.size());
        kind = kind.substr(0, kind.find(':'));
        const auto one = matrix_of(kind, operation->value.numbers);
        if (!one || (is_inverse && !(std::abs(glm::determinant(*one)) > 0))) {
            text.fail(
                operation->value.line,
                in_quotes(entry) + " of prim <" + prim.path + "> is not " +
                    (one ? "invertible"
                         : "translate, scale, rotate, orient or transform with finite numbers"));
        }
        matrix = matrix * (is_inverse ? glm::inverse(*one) : *one);
    }
    return matrix;
}

} // namespace geodisk::tools
