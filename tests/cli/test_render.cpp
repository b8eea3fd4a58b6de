// `geodisk render` shows what there is, where it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/png_image.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kRenderedMesh = "builtin:torus-knot:8";

void make_samples(const TemporaryFolder& folder, const std::string& mesh = kRenderedMesh) {
    REQUIRE(run(folder, {"sample", mesh, "-o", "a.ply", "-n", "400"}).status == 0);
}

/// Draws into p.png.
PngImage picture(const TemporaryFolder& folder, const Arguments& arguments) {
    const Outcome outcome =
        run(folder, joined({"render"}, joined(arguments, {"-o", "p.png", "-q"})));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    REQUIRE(outcome.out.empty());
    return read_png(folder / "p.png");
}

bool is_transparent(Pixel p) {
    return p.alpha == 0;
}
bool is_orange(Pixel p) {
    return p.alpha == 255 && p.red > p.green + 40 && p.green > p.blue + 40;
}
/// The surface itself is nearly grey, and light.
bool is_bare(Pixel p) {
    return p.alpha == 255 && p.red > 150 && p.red >= p.blue;
}

template <class Is>
double count_if(const PngImage& image, const Is& is) {
    return static_cast<double>(std::count_if(image.pixels.begin(), image.pixels.end(), is));
}

} // namespace

TEST_CASE("a mesh is sampled and drawn at once") {
    const TemporaryFolder folder;
    make_samples(folder);
    const Outcome outcome =
        run(folder, {"sample", kRenderedMesh, "-n", "400", "-o", "b.ply", "--picture", "b.png",
                     "--json", "b.json", "-q", "--validate"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(bytes_of(folder / "b.ply") == bytes_of(folder / "a.ply"));
    CHECK(nlohmann::json::parse(bytes_of(folder / "b.json"))["picture"] == "b.png");
    REQUIRE(run(folder, {"render", kRenderedMesh, "a.ply", "-o", "a.png"}).status == 0);
    CHECK(bytes_of(folder / "b.png") == bytes_of(folder / "a.png"));

    const Arguments good = {"sample", kRenderedMesh, "-n", "400", "-o", "c.ply", "--picture"};
    REQUIRE(run(folder, joined(good, {"c.png", "--legend"})).status == 0);
    REQUIRE(run(folder, {"render", kRenderedMesh, "a.ply", "-o", "a.png", "--legend"}).status == 0);
    CHECK(bytes_of(folder / "c.png") == bytes_of(folder / "a.png"));
    CHECK(bytes_of(folder / "c.png") != bytes_of(folder / "b.png"));
    check_fails(folder, 2, "--picture FILE",
                {"sample", kRenderedMesh, "-n", "400", "-o", "c.ply", "--legend"});
    check_fails(
        folder, 2, "--legend does not fit into a view of 40 x 40 pixels",
        {"render", kRenderedMesh, "a.ply", "-o", "small.png", "--size", "40x40", "--legend"});
    CHECK_FALSE(std::filesystem::exists(folder / "small.png"));
    check_fails(folder, 2, "*.png", joined(good, {"c.jpg"}));
    check_fails(folder, 2, "the picture would replace the samples", joined(good, {"c.ply"}));
    check_fails(folder, 4, "nowhere", joined(good, {"nowhere/c.png"}));
}

TEST_CASE("disks cover the area that they have") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"box", "--dim", "2", "--periodic", "-d", "0.1", "-o", "a.csv"}).status ==
            0);
    const double count =
        static_cast<double>(tools::read_box_samples(tools::Path(folder / "a.csv")).rows.size());
    const Arguments drawn = {"a.csv", "--size", "1000x1000", "--background", "transparent"};
    const PngImage image = picture(folder, drawn);
    CHECK(image.width == 1000);
    CHECK(image.height == 1000);
    const double all = 1000 * 1000 - count_if(image, is_transparent);
    CHECK(all / (1000.0 * 1000) == doctest::Approx(0.94 * 0.94).epsilon(0.01));
    const double covered = 1 - count_if(image, is_bare) / all;
    CHECK(covered == doctest::Approx(count * std::numbers::pi * 0.05 * 0.05).epsilon(0.03));
    CHECK(count_if(image, is_orange) == 0);

    // Disks that are a tenth too large overlap somewhere, but not everywhere.
    const PngImage large = picture(folder, joined(drawn, {"--radius", "0.055"}));
    CHECK(count_if(large, is_orange) > 50);
    CHECK(count_if(large, is_orange) < 0.1 * all);
    CHECK(1 - count_if(large, is_bare) / all > covered + 0.05);
}

TEST_CASE("a disk is along the surface: not on the other side of a thin plate") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", "builtin:plate:4", "-n", "100", "-o", "a.ply"}).status == 0);
    tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    const auto off_middle = [](const tools::SampleRow& row) {
        return std::hypot(row.position[0], row.position[1]);
    };
    std::swap(samples.rows.front(), *std::min_element(samples.rows.begin(), samples.rows.end(),
                                                      [&](const auto& a, const auto& b) {
                                                          return off_middle(a) < off_middle(b);
                                                      }));
    samples.rows.resize(1);
    tools::write_samples(folder / "a.csv", samples.header, samples.rows, false);
    const auto blue_from = [&](const char* view) {
        const PngImage image = picture(folder, {"builtin:plate:4", "a.csv", "--view", view, "--up",
                                                "z", "--size", "200x200", "-r", "0.2"});
        return count_if(image, [](Pixel p) { return p.blue > p.red + 25; });
    };
    const double top = blue_from("top"), bottom = blue_from("bottom");
    CHECK(std::max(top, bottom) > 1000);
    CHECK(std::min(top, bottom) == 0);
}

TEST_CASE("the style is disks where these are wide enough to tell apart, else points") {
    const TemporaryFolder folder;
    make_samples(folder);
    const auto check = [&](const char* size, const char* style) {
        const Arguments drawn = {kRenderedMesh, "a.ply", "--size", size};
        const PngImage chosen = picture(folder, joined(drawn, {"--json", "p.json"}));
        CHECK(nlohmann::json::parse(bytes_of(folder / "p.json"))["style"] == style);
        CHECK(chosen.pixels == picture(folder, joined(drawn, {"--style", style})).pixels);
    };
    check("160x120", "points");
    check("900x675", "disks");
}

TEST_CASE("each style draws another picture, and each run the same") {
    const TemporaryFolder folder;
    make_samples(folder);
    std::set<std::string> files;
    for (const std::string style : {"disks", "points", "voronoi", "distance", "density"}) {
        CAPTURE(style);
        const Arguments drawn = {kRenderedMesh, "a.ply", "--style", style, "--size", "160x120"};
        const PngImage image = picture(folder, drawn);
        CHECK(image.width == 160);
        CHECK(image.height == 120);
        const std::string bytes = bytes_of(folder / "p.png");
        CHECK(files.insert(bytes).second);
        picture(folder, drawn);
        CHECK(bytes_of(folder / "p.png") == bytes);
    }
}

TEST_CASE("several views make a sheet, and the report tells of it") {
    const TemporaryFolder folder;
    make_samples(folder);
    const Outcome outcome =
        run(folder, {"render", kRenderedMesh, "a.ply", "-o", "p.png", "--size", "300x100", "--view",
                     "auto", "--view", "top", "--view", "-20,35", "--up", "z", "--json", "-"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto report = nlohmann::json::parse(outcome.out);
    CHECK(report["views"].size() == 3);
    CHECK(report["views"][1]["elevation"] == 90);
    CHECK(report["views"][2]["azimuth"] == -20);
    CHECK(report["up"] == "z");
    CHECK(report["width"] == 300);
    CHECK(report["samples"].get<int>() > 300);
    CHECK(report["windows"].get<int>() > 300);
    CHECK(report["mesh"]["path"] == kRenderedMesh);
    const PngImage image = read_png(folder / "p.png");
    for (std::size_t pane = 0; pane < 3; ++pane) { // Each shows something.
        std::size_t drawn = 0;
        for (std::size_t y = 0; y < 100; ++y) {
            for (std::size_t x = 100 * pane; x < 100 * (pane + 1); ++x) {
                const Pixel p = image.pixels[300 * y + x];
                drawn += p != Pixel{255, 255, 255, 255};
            }
        }
        CAPTURE(pane);
        CHECK(drawn > 1000);
    }
}

TEST_CASE("surfaces of every kind can be seen") {
    const TemporaryFolder folder;
    for (const std::string mesh : {"builtin:cube", "builtin:moebius:4", "builtin:clifford-torus:16",
                                   "builtin:terrain:12", "builtin:spike"}) {
        CAPTURE(mesh);
        make_samples(folder, mesh);
        const PngImage image = picture(folder, {mesh, "a.ply", "--size", "120x120", "--background",
                                                "transparent", "--validate"});
        CHECK(count_if(image, is_transparent) < 0.97 * 120 * 120);
        CHECK(count_if(image, is_transparent) > 0);
    }
}

TEST_CASE("samples in space are balls in a frame") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"box", "--dim", "3", "-d", "0.1", "-o", "a.csv"}).status == 0);
    const Arguments drawn = {"a.csv",        "--size",      "200x200",
                             "--background", "transparent", "--validate"};
    const double disks = count_if(picture(folder, drawn), is_transparent);
    const double points =
        count_if(picture(folder, joined(drawn, {"--style", "points"})), is_transparent);
    CHECK(disks < 0.5 * 200 * 200);
    CHECK(points > 1.2 * disks);
    const PngImage whole = picture(folder, drawn);
    const PngImage cut = picture(folder, joined(drawn, {"--cut"}));
    CHECK(count_if(whole, is_bare) == 0);
    CHECK(count_if(cut, is_bare) > 0.01 * 200 * 200); // Sections.
    // Behind what was taken away there are others.
    CHECK(count_if(cut, is_transparent) < 1.1 * disks);
    check_fails(folder, 2, "is for surfaces",
                {"render", "a.csv", "-o", "q.png", "--style", "voronoi"});
    make_samples(folder);
    check_fails(folder, 2, "--cut", {"render", kRenderedMesh, "a.ply", "-o", "q.png", "--cut"});
}

TEST_CASE("radii that vary are those of the file") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", "builtin:showpiece:60", "--density", "curvature", "-n", "300",
                         "-o", "a.ply"})
                .status == 0);
    const Arguments drawn = {
        "builtin:showpiece:60", "a.ply", "--size", "240x240", "--style", "disks"};
    const PngImage image = picture(folder, drawn);
    CHECK(count_if(image, is_orange) == 0);
    const PngImage wrong = picture(folder, joined(drawn, {"--radius", "5%"}));
    CHECK(count_if(wrong, is_orange) > 100);
}

TEST_CASE("samples without a distance are drawn by that of the closest pair") {
    TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kRenderedMesh, "-n", "30", "-o", "a.ply"}).status == 0);
    tools::write_samples(folder / "bare.csv", {}, tools::read_samples(folder / "a.ply").rows,
                         false);
    const Outcome bare = run(folder, {"render", kRenderedMesh, "bare.csv", "-o", "p.png"});
    CHECK(bare.status == 0);
    CHECK(bare.err.find("closest pair") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "p.png"));
}

TEST_CASE("what cannot be drawn is told, and leaves no picture") {
    const TemporaryFolder folder;
    make_samples(folder);
    const Arguments good = {"render", kRenderedMesh, "a.ply", "-o", "p.png", "--size", "100x100"};
    check_fails(folder, 2, "*.png", {"render", kRenderedMesh, "a.ply", "-o", "p.jpg"});
    check_fails(folder, 2, "SAMPLES is required", {"render", kRenderedMesh, "-o", "p.png"});
    for (const std::string size : {"100", "100x", "x100", "8x100", "100x20000", "1e3x100"}) {
        check_fails(folder, 2, "--size",
                    {"render", kRenderedMesh, "a.ply", "-o", "p.png", "--size", size});
    }
    check_fails(folder, 2, "--style", joined(good, {"--style", "dots"}));
    check_fails(folder, 2, "--view", joined(good, {"--view", "sideways"}));
    check_fails(folder, 2, "--up", joined(good, {"--up", "north"}));
    check_fails(folder, 2, "--background", joined(good, {"--background", "#fff"}));
    check_fails(folder, 2, "--radius", joined(good, {"--radius", "0"}));
    check_fails(folder, 2, "contradict each other", joined(good, {"-d", "0.1", "-r", "0.1"}));
    check_fails(folder, 2, "would replace",
                {"render", kRenderedMesh, "a.ply", "-o", "p.png", "--json", "p.png"});
    check_fails(folder, 5, "nowhere", joined(good, {"--device", "nowhere"}));
    // Samples of another mesh, and none.
    check_fails(folder, 3, "sample", {"render", "builtin:cube", "a.ply", "-o", "p.png"});
    check_fails(folder, 3, "another mesh",
                {"render", "builtin:torus-knot:9", "a.ply", "-o", "p.png"});
    folder.write("none.csv", "# min_distance: 0.1\nface_index,bary_u,bary_v,bary_w,x,y,z\n");
    check_fails(folder, 3, "no samples", {"render", kRenderedMesh, "none.csv", "-o", "p.png"});
    // Boxes of other dimensions, and what is no box.
    REQUIRE(run(folder, {"box", "--dim", "4", "-n", "30", "-o", "box.csv"}).status == 0);
    check_fails(folder, 3, "4 dimensions", {"render", "box.csv", "-o", "p.png"});
    check_fails(folder, 3, "no box", {"render", "a.ply", "-o", "p.png"});
    // Lengths leave nothing to look at.
    folder.write("bare.obj", "f 1 2 3\n");
    folder.write("lengths.txt", "1 2 3\n2 3 4\n1 3 5\n");
    folder.write("one.csv", "# min_distance: 1\nface_index,bary_u,bary_v,bary_w\n0,1,0,0\n");
    check_fails(folder, 3, "no coordinates",
                {"render", "bare.obj", "one.csv", "-o", "p.png", "--edge-lengths", "lengths.txt"});
    check_fails(folder, 3, "no coordinates",
                {"sample", "bare.obj", "-d", "1", "-o", "p.csv", "--picture", "p.png",
                 "--edge-lengths", "lengths.txt"});
}

} // namespace geodisk::test
