// Meshes in very small and very large units: all commands give what they give in usual ones.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "cli/page_file.hpp"
#include "files/samples/sample_file.hpp"
#include "program/exact_text.hpp"

namespace geodisk::test {
namespace {

// Powers of two, by which doubles change in their exponents alone.
constexpr double kUnits[] = {0x1p-200, 0x1p40, 0x1p130};

/// Writes a rough square of 8 by 8 cells, with a bump of this height, as OBJ.
void write_rough(const TemporaryFolder& folder, const std::string& name, double unit, double bump) {
    std::ofstream file(folder / name);
    for (int i = 0; i < 81; ++i) {
        const double height = (i * i % 13) / 32.0 + (i == 40 ? bump : 0);
        const int column = i % 9, row = i / 9;
        file << "v " << tools::exact_text(column * 0.25 * unit) << ' '
             << tools::exact_text(row * 0.25 * unit) << ' ' << tools::exact_text(height * unit)
             << '\n';
    }
    for (int cell = 0; cell < 64; ++cell) {
        const int a = cell / 8 * 9 + cell % 8 + 1;
        file << "f " << a << ' ' << a + 1 << ' ' << a + 10 << '\n';
        file << "f " << a << ' ' << a + 10 << ' ' << a + 9 << '\n';
    }
}

/// Faces and weights of samples.
std::vector<double> places_in(const TemporaryFolder& folder, const std::string& name) {
    std::vector<double> places;
    for (const tools::SampleRow& row : tools::read_samples(folder / name).rows) {
        places.push_back(row.face);
        places.insert(places.end(), std::begin(row.bary), std::end(row.bary));
    }
    return places;
}

/// Results of the commands for a mesh, without its unit.
struct Given {
    std::vector<double> sampled, of_classes, updated, of_batch, page_radii, page_distances;
    Json analysis, verified;
    std::string picture;
};

Given given_in(double unit) {
    const TemporaryFolder folder;
    write_rough(folder, "a.obj", unit, 0);
    write_rough(folder, "b.obj", unit, 0.25);
    const auto length = [&](double units) { return tools::exact_text(units * unit); };
    const auto done = [&](const Arguments& arguments) {
        const Outcome outcome = run(folder, arguments);
        INFO(arguments[0], ": ", outcome.err);
        REQUIRE(outcome.status == 0);
    };
    const std::string classes =
        length(0.5) + ',' + length(0.375) + ';' + length(0.375) + ',' + length(0.25);
    folder.write("list.txt", "b.obj --classes \"" + classes + "\" -o c.csv\n");
    done({"sample", "a.obj", "-d", length(0.25), "-o", "a.csv"});
    done({"sample", "a.obj", "--classes", classes, "-o", "k.csv"});
    done({"sample", "b.obj", "--from", "a.obj", "--update", "a.csv", "-d", length(0.25), "-o",
          "u.csv"});
    done({"batch", "list.txt", "-d", "10%", "-o", "out", "--format", "csv"});
    done({"analyze", "a.obj", "k.csv", "--json", "a.json"});
    done({"verify", "b.obj", "u.csv", "--json", "v.json"});
    done({"render", "a.obj", "a.csv", "-o", "a.png", "--size", "300x200"});
    Given given{places_in(folder, "a.csv"),
                places_in(folder, "k.csv"),
                places_in(folder, "u.csv"),
                places_in(folder, "out/c.csv"),
                {},
                {},
                json_in(folder, "a.json")["sets"][0],
                json_in(folder, "v.json"),
                bytes_of(folder / "a.png")};
    const Outcome page =
        run(folder, {"report", "a.obj", "--classes", classes, "-o", "a.html", "--probes", "100"});
    if (!contains(page.err, "three.js")) { // Else this program makes no pages.
        INFO(page.err);
        REQUIRE(page.status == 0);
        const PageFile found = read_page(folder / "a.html");
        given.page_radii = found.arrays.at("sample_radii");
        given.page_distances = found.arrays.at("sample_distances");
    }
    return given;
}

void check_scaled(const std::vector<double>& found, const std::vector<double>& wanted,
                  double unit) {
    REQUIRE(found.size() == wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        REQUIRE(found[i] / unit == doctest::Approx(wanted[i]).epsilon(1e-6));
    }
}

} // namespace

TEST_CASE("the unit of a mesh changes no samples, figures, pages and pictures") {
    const Given wanted = given_in(1);
    REQUIRE(wanted.of_batch.size() > 100);
    for (const double unit : kUnits) {
        CAPTURE(unit);
        const Given found = given_in(unit);
        CHECK(found.sampled == wanted.sampled);
        CHECK(found.of_classes == wanted.of_classes);
        CHECK(found.updated == wanted.updated);
        CHECK(found.of_batch == wanted.of_batch);
        CHECK(found.picture == wanted.picture);
        for (const char* const key : {"samples", "smallest", "mean_nearest", "uncovered"}) {
            CAPTURE(key);
            CHECK(double{found.analysis[key]} ==
                  doctest::Approx(double{wanted.analysis[key]}).epsilon(1e-9));
        }
        CHECK(found.verified["violations"] == wanted.verified["violations"]);
        check_scaled(found.page_radii, wanted.page_radii, unit);
        check_scaled(found.page_distances, wanted.page_distances, unit);
    }
}

} // namespace geodisk::test
