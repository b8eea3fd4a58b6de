// Commands of the program on meshes and samples in memory.
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "c/c_call.hpp"
#include "c/c_cells.hpp"
#include "c/c_mesh.hpp"
#include "files/images/textures.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/frame_style.hpp"
#include "files/samples/sample_fields.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_format.hpp"
#include "files/samples/sample_records.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/vulkan_environment.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/commands/verify.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/map_run.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/outputs/map_output.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/picture_run.hpp"
#include "geodisk/reports/json.hpp"
#include "geometry/set_warnings.hpp"
#include "geometry/shape_warnings.hpp"
#include "geometry/surface_warnings.hpp"
#include "picture/png.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "source.hpp"

using namespace geodisk;
using namespace geodisk::tools;

namespace {

/// Names of samples and their mesh in messages.
constexpr const char *kSamplesName = "samples", *kMeshName = "mesh";

float to_float(double value) {
    return static_cast<float>(value);
}

/// A task while it runs.
struct RunningTask {
    const geodisk_task& task;
    Json options;
    geodisk_take_fn take;
    ProgressLine progress{true};

    template <class Array>
    void hand_over(const Array& array) const {
        const auto bytes = std::as_bytes(std::span(array));
        take(bytes.data(), bytes.size());
    }
    void hand_over(const std::vector<MeshWarning>& warnings) const {
        hand_over(text_of(warnings_json(warnings)));
    }
};

/// Returns the library's mesh as commands take it. One in the plane lies in that of z = 0.
MeshInput mesh_input(const geodisk_mesh& given) {
    const c::Mesh& mesh = *given.shared;
    MeshFile file;
    file.dimension = std::max(mesh.dimension, 3u);
    file.positions = mesh.positions;
    if (mesh.dimension == 2) {
        file.positions.clear();
        for (std::size_t i = 0; i < mesh.positions.size(); i += 2) {
            file.positions.insert(file.positions.end(),
                                  {mesh.positions[i], mesh.positions[i + 1], 0});
        }
    }
    std::ranges::transform(mesh.prepared.half_edges(), std::back_inserter(file.triangles),
                           &HalfEdge::origin);
    MeshInput input{std::move(file), mesh.prepared, {}, {}, 1, {}};
    input.path = kMeshName;
    return input;
}

/// Returns samples as a reader of files does. Throws UserError.
SampleFile sample_file(const geodisk_task& task, const Json& options) {
    const auto names = options.at("columns").get<std::vector<std::string>>();
    const auto place_of = [&](std::string_view name) -> std::optional<std::size_t> {
        const auto found = std::ranges::find(names, name);
        return found == names.end() ? std::nullopt : std::optional(found - names.begin());
    };
    const bool is_on_surface = task.mesh != nullptr || place_of("face_index");
    const ColumnPlaces places = find_places(
        kSamplesName, is_on_surface ? SampleDomain::surface : SampleDomain::box, place_of);
    ExtraReader extra(kSamplesName, place_of, "");
    SampleFile samples;
    samples.path = kSamplesName;
    samples.dimension = places.dimension();
    samples.has_faces = places.has_faces;
    for (std::size_t i = 0; i < options.at("count").get<std::size_t>(); ++i) {
        const auto value_at = [&](std::size_t place) {
            return task.samples[i * names.size() + place];
        };
        samples.rows.push_back(make_row(places, value_at, [&](const std::string& message) {
            fail_input(kSamplesName, "sample " + std::to_string(i) + ": " + message);
        }));
        extra.add_row([&](std::size_t place) { return std::optional(value_at(place)); });
    }
    std::move(extra).move_to(samples);
    for (const auto& [key, value] : options.at("header").items()) {
        samples.header.entries.emplace_back(key, value);
    }
    return samples;
}

/// Puts samples on `mesh`. Throws UserError for those that are not of it.
SampleInput samples_on(const MeshInput& mesh, RunningTask& run) {
    const std::string tolerance = run.options.at("tolerance");
    check_tolerance(tolerance);
    SampleInput input{sample_file(run.task, run.options), {}};
    std::vector<MeshWarning> warnings; // Python has its own.
    put_on_mesh(mesh, tolerance, input, warnings, run.progress);
    return input;
}

template <class Value>
std::uintptr_t address_of(const std::vector<Value>& values) {
    return values.empty() ? 0 : reinterpret_cast<std::uintptr_t>(values.data());
}

Json attribute_json(const MeshFile& mesh, const MeshField& field) {
    const bool of_vertices = field.of == MeshField::Of::vertices;
    const bool of_corners = field.of == MeshField::Of::corners;
    return {{"name", field.name},
            {"values", address_of(field.values)},
            {"components", field.components.size()},
            {"count", field.values.size() / field.components.size()},
            {"corners", of_vertices  ? address_of(mesh.corners_in_file())
                        : of_corners ? address_of(field.corners)
                                     : 0},
            {"of_vertices", of_vertices},
            {"is_whole", field.is_whole},
            {"is_light", field.is_light}};
}

void describe(RunningTask& run) {
    const MeshFile& mesh = run.task.source->mesh;
    Json attributes = Json::array(), columns = Json::array();
    for (const MeshField& field : mesh.fields) {
        attributes.push_back(attribute_json(mesh, field));
    }
    for (const std::vector<std::uint32_t>& column : run.task.source->columns) {
        columns.push_back(address_of(column));
    }
    run.hand_over(text_of(Json{{"positions", address_of(mesh.positions)},
                               {"dimension", mesh.dimension},
                               {"vertex_count", mesh.positions.size() / mesh.dimension},
                               {"triangles", address_of(mesh.triangles)},
                               {"triangle_count", mesh.triangle_count()},
                               {"polygons", address_of(mesh.polygons)},
                               {"joined", address_of(mesh.joined)},
                               {"joined_edges", mesh.weld ? mesh.weld->joined_edges : 0},
                               {"corners", address_of(mesh.corners_in_file())},
                               {"attributes", attributes},
                               {"columns", columns},
                               {"is_y_up", run.task.source->is_y_up}}));
}

void verify(RunningTask& run) {
    VerifyOptions options;
    options.mesh.mesh = kMeshName;
    options.samples = kSamplesName;
    options.min_distance = run.options.at("min_distance");
    options.is_maximal = run.options.at("maximal");
    const geodisk_task& task = run.task;
    if (task.mesh == nullptr) {
        const SampleFile samples = sample_file(task, run.options);
        run.hand_over(report_json(samples, check_box(options.min_distance, samples, run.progress)));
        return;
    }
    MeshInput mesh = mesh_input(*task.mesh);
    if (task.radii != nullptr) {
        mesh.radii = task.radii->shared->field;
        mesh.distance_part = run.options.at("distance_part");
    }
    if (task.face_mask != nullptr) {
        mesh.face_mask.assign(task.face_mask, task.face_mask + mesh.prepared.face_count());
    }
    Avoided avoided;
    avoided.points = run.options.at("avoided");
    avoided.classes.assign(avoided.points, kAllClasses);
    SampleFile places;
    places.path = "avoid";
    for (std::size_t i = 0; i < avoided.points; ++i) {
        avoided.disks.push_back({c::sample_of(task.avoid[i]), task.avoid_radii[i]});
        places.rows.emplace_back().face = task.avoid[i].face;
        std::ranges::copy(task.avoid[i].weights, places.rows.back().bary);
    }
    check_rows(places, mesh, "point");
    auto [samples, strays] = samples_on(mesh, run);
    run.hand_over(report_json(check_samples(options, mesh, samples, std::move(strays),
                                            wanted_spacing(options, samples, mesh), avoided, {},
                                            run.progress)));
}

/// Returns the samples on their mesh, after handing over where that is.
SampleFile place(RunningTask& run) {
    const MeshInput mesh = mesh_input(*run.task.mesh);
    SampleFile samples = without_strays(mesh, samples_on(mesh, run));
    std::vector<std::uint32_t> faces;
    std::vector<float> weights;
    for (const SampleRow& row : samples.rows) {
        faces.push_back(row.face);
        weights.insert(weights.end(), row.bary, row.bary + 3);
    }
    run.hand_over(faces);
    run.hand_over(weights);
    return samples;
}

void transfer(RunningTask& run) {
    std::vector<SampleRow> rows = place(run).rows;
    const MeshInput to = mesh_input(*run.task.to);
    std::vector<double> points;
    std::vector<float> normals;
    for (SampleRow& row : rows) {
        to.place(row);
        points.insert(points.end(), row.position, row.position + to.dimension());
        normals.insert(normals.end(), row.normal, row.normal + 3);
    }
    const std::optional<ClosePair> closest = find_closest(to, rows, run.progress);
    run.hand_over(points);
    run.hand_over(normals);
    run.hand_over(
        std::array{closest ? closest->distance : std::numeric_limits<double>::quiet_NaN()});
}

void bake(RunningTask& run) {
    const MapSize size{{run.options.at("width"), run.options.at("height")},
                       run.options.at("padding")};
    const MapResult found = look_up_map(run.task.source->mesh, size, run.options.at("path"),
                                        run.task.nearest->disks, run.progress);
    run.hand_over(found.map.samples);
    run.hand_over(found.map.distances);
    run.hand_over(found.map.faces);
    run.hand_over(std::array{found.overlapping});
}

/// Writes a map that `bake` handed over, as arrays or a picture of distances.
void save_map(RunningTask& run) {
    const geodisk_task& task = run.task;
    const Path path = run.options.at("path").get<std::string>();
    const MapTarget target = parse_map_target(path, "distance", run.options.at("depth"));
    SampleMap map{run.options.at("width"), run.options.at("height"), {}, {}, {}};
    const std::size_t texels = std::size_t{map.width} * map.height;
    map.samples.assign(task.map_samples, task.map_samples + texels);
    map.distances.assign(task.map_distances, task.map_distances + texels);
    map.faces.assign(task.map_faces, task.map_faces + texels);
    AtomicFile file(path);
    write_map(file, target, map, 0, {});
    file.commit();
}

/// Returns samples of a mesh, by weights and normals.
std::vector<SampleRow> recorded_rows(const RunningTask& run, const MeshFile& mesh) {
    std::vector<SampleRow> rows(run.options.at("count"));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].face = run.task.faces[i];
        const double* const numbers = run.task.samples + 6 * i;
        std::ranges::transform(numbers, numbers + 3, rows[i].bary, to_float);
        std::ranges::transform(numbers + 3, numbers + 6, rows[i].normal, to_float);
        if (rows[i].face >= mesh.triangle_count() || mesh.dimension != 3) {
            fail_usage("samples are not of this mesh, or it is not in space");
        }
    }
    return rows;
}

void record(RunningTask& run) {
    const MeshFile& mesh = run.task.source->mesh;
    std::vector<SampleRow> rows = recorded_rows(run, mesh);
    if (const std::string kind = run.options.at("normals"); kind != "face") {
        if (kind == "file" && !mesh.normals) {
            fail_usage("the normals of the file were not read");
        }
        kind == "file" ? set_file_normals(mesh, rows) : set_smooth_normals(mesh, rows);
        std::vector<float> normals;
        for (const SampleRow& row : rows) {
            normals.insert(normals.end(), row.normal, row.normal + 3);
        }
        run.hand_over(normals);
    }
    if (run.task.path != nullptr) {
        const bool is_auto = std::string_view(run.task.path) == kAutoTexture;
        if (is_auto ? !mesh.materials : !mesh.texture_uvs || mesh.materials) {
            fail_usage("a texture needs texture coordinates or materials");
        }
        const Textures textures = is_auto ? Textures(mesh) : Textures(mesh, Path(run.task.path));
        run.hand_over(texture_colours(mesh, textures, rows).values);
    }
    if (const std::string frames = run.options.at("frames"); !frames.empty()) {
        FrameStyle style = parse_frame_style("frames", frames);
        style.world = find_up(run.options.at("up").get<std::string>()).value_or(style.world);
        run.hand_over(sample_frames(rows, run.options.at("seed"), style).values);
    }
}

/// Opens a device that draws. Python warns of missing drivers.
Context drawing_context(const std::string& device) {
    ContextOptions wanted;
    wanted.device = device;
    wanted.graphics = true;
    wanted.keep_pipelines = true;
    return take(Context::create(wanted));
}

void render(RunningTask& run) {
    RenderOptions options;
    options.mesh.mesh = kMeshName;
    options.samples = kSamplesName;
    options.size = run.options.at("size");
    options.style = run.options.at("style");
    options.background = run.options.at("background");
    options.up.axis = run.options.at("up");
    options.views = run.options.at("views").get<std::vector<std::string>>();
    options.cuts = run.options.at("cut");
    options.legend = run.options.at("legend");
    options.distance.min_distance = run.options.at("min_distance");
    const OpenContext open = [&] { return drawing_context(run.options.at("device")); };
    DrawnPicture drawn;
    if (run.task.mesh == nullptr) {
        const SampleFile samples = sample_file(run.task, run.options);
        const BoxParams box = box_to_draw(options, samples);
        drawn = draw_box(options, box, samples, open, run.progress);
    } else {
        const MeshInput mesh = mesh_input(*run.task.mesh);
        const SampleFile samples = without_strays(mesh, samples_on(mesh, run));
        std::vector<MeshWarning> warnings;
        drawn = draw_samples(options, mesh, samples, warnings, open, run.progress);
    }
    run.hand_over(picture::png_of(drawn.picture.pixels));
}

/// Returns the attributes that options name by their columns.
std::vector<SampleField> fields_of(const geodisk_task& task, const Json& options) {
    const std::size_t columns = options.at("columns").size();
    std::vector<SampleField> fields;
    for (const Json& given : options.at("fields")) {
        SampleField field;
        field.name = given.at("name");
        field.components = given.at("components").get<std::vector<std::string>>();
        field.is_whole = given.at("whole");
        field.is_colour = given.at("colour");
        const auto first = given.at("first").get<std::size_t>();
        for (std::size_t i = 0; i < options.at("count").get<std::size_t>(); ++i) {
            const double* const row = task.samples + i * columns + first;
            field.values.insert(field.values.end(), row, row + field.components.size());
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

void save(RunningTask& run) {
    SampleTarget target = sample_target(Path(run.options.at("path").get<std::string>()));
    SampleFile samples = sample_file(run.task, run.options);
    if (const std::string* const up = samples.header.find("frames_up")) {
        target.up = find_up(*up).value_or(target.up);
    }
    if (const Json& pixel = run.options.at("pixel_size"); !pixel.is_null()) {
        target.pixel_size = pixel.get<double>();
    }
    check_dimension(target, samples.dimension);
    const std::vector<SampleField> fields = fields_of(run.task, run.options);
    std::vector<std::string> names(fields.size());
    std::ranges::transform(fields, names.begin(), &SampleField::name);
    check_columns(target, names);
    AtomicFile file(target.path);
    if (samples.has_faces) {
        write_samples(file, target, samples.header, samples.rows, samples.dimension,
                      {samples.extra, fields});
    } else {
        write_box_samples(file, target, samples.header, samples.rows, samples.dimension);
    }
    file.commit();
}

void read_frame_style(RunningTask& run) {
    const FrameStyle style = parse_frame_style("frames", run.options.at("text").get<std::string>());
    run.hand_over(text_of(Json{{"text", text_of(style)}, {"has_up", style.has_world()}}));
}

bool is_about_seams(const MeshWarning& warning) {
    return warning.kind == "unwelded" || warning.kind == "near_seams";
}

/// Warnings about arrays of the caller, of which only the prepared mesh knows.
std::vector<MeshWarning> array_warnings(const c::Mesh& mesh) {
    std::vector<MeshWarning> warnings;
    warn_of_repeated_vertices(warnings, mesh.prepared.statistics().repeated_index_faces, "");
    MeshFile file;
    if (mesh.dimension > 0) {
        file.positions = mesh.positions;
        file.triangles = mesh.triangles;
        file.dimension = mesh.dimension;
        warn_of_shapes(shapes_of(file), file);
        std::ranges::move(file.warnings, std::back_inserter(warnings));
        warn_of_near_seams(mesh.view(), mesh.prepared.statistics(), warnings);
    }
    file.lengths.resize(1); // No reader has judged the areas.
    std::ranges::move(surface_warnings(file, mesh.prepared), std::back_inserter(warnings));
    return warnings;
}

void warnings_of_mesh(RunningTask& run) {
    const geodisk_task& task = run.task;
    const c::Mesh& mesh = *task.mesh->shared;
    std::vector<MeshWarning> warnings;
    if (task.source == nullptr) {
        warnings = array_warnings(mesh);
    } else {
        warnings = task.source->mesh.warnings;
        std::ranges::move(surface_warnings(task.source->mesh, mesh.prepared),
                          std::back_inserter(warnings));
    }
    std::stable_partition(warnings.begin(), warnings.end(), is_about_seams);
    run.hand_over(warnings);
}

void warnings_of_set(RunningTask& run) {
    const geodisk_task& task = run.task;
    const Json& options = run.options;
    SampledSet set{.samples = options.at("count"),
                   .existing = options.at("existing"),
                   .avoids = options.at("avoids"),
                   .min_distance = options.at("min_distance"),
                   .wanted_count = options.at("wanted_count"),
                   .cut = options.at("cut"),
                   .stop_count = options.at("stop_count"),
                   .has_darts = options.at("has_darts"),
                   .lacks_features = options.at("lacks_features")};
    if (task.mesh == nullptr) {
        set.domain = "box";
    } else {
        const PreparedMesh& mesh = task.mesh->shared->prepared;
        const std::size_t masked = task.face_mask != nullptr ? mesh.face_count() : 0;
        set.bare = parts_without(mesh, std::span(task.faces, set.samples),
                                 std::span(task.face_mask, masked));
    }
    run.hand_over(set_warnings(set));
}

void warnings_of_drivers(RunningTask& run) {
    std::vector<MeshWarning> list;
    for (const std::string& driver : left_out_drivers()) {
        list.push_back({"left_out_driver", 1, "", left_out_warning(driver), {}});
    }
    run.hand_over(list);
}

void run_named(std::string_view name, RunningTask& run) {
    constexpr std::pair<std::string_view, void (*)(RunningTask&)> kCommands[] = {
        {"describe", &describe},
        {"verify", &verify},
        {"place", [](RunningTask& one) { static_cast<void>(place(one)); }},
        {"transfer", &transfer},
        {"bake", &bake},
        {"save_map", &save_map},
        {"record", &record},
        {"render", &render},
        {"save", &save},
        {"frame_style", &read_frame_style},
        {"warnings_of_mesh", &warnings_of_mesh},
        {"warnings_of_set", &warnings_of_set},
        {"warnings_of_drivers", &warnings_of_drivers},
        {"explain_no_device", [](RunningTask& one) {
             one.hand_over(with_driver_fault(one.options.at("message").get<std::string>()));
         }}};
    for (const auto& [known, body] : kCommands) {
        if (known == name) {
            body(run);
        }
    }
}

Error error_of(const UserError& failure) {
    switch (failure.code()) {
    case ExitCode::usage:
    case ExitCode::bad_input:
        return c::wrong(failure.what());
    case ExitCode::no_device:
        return {Status::no_device, failure.what()};
    case ExitCode::out_of_memory:
        return {Status::out_of_host_memory, failure.what()};
    default:
        return {is_interrupted() ? Status::cancelled : Status::internal, failure.what()};
    }
}

} // namespace

extern "C" geodisk_status geodisk_run_command(const char* name, const geodisk_task* task,
                                              geodisk_take_fn take, geodisk_error* error) {
    return c::answer(error, [&]() -> Result<Done> {
        const auto given = c::taken(task, "task");
        if (!given) {
            return given.error();
        }
        const StopFlag flag(given->stop);
        try {
            RunningTask run{*given, Json::parse(given->options), take};
            run_named(name, run);
        } catch (const UserError& failure) {
            return error_of(failure);
        }
        return Done{};
    });
}
