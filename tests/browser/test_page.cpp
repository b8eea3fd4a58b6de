// Pages of `geodisk report` in a browser, opened as files.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "browser/web_driver.hpp"
#include "cli/command.hpp"
#include "cli/png_image.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kMesh = "builtin:torus-knot:16";
/// Minimum number of pictures on the CPU, which a busy machine gives little time.
constexpr double kMinFrames = 2;
constexpr double kLongestLoad = 20000; // Milliseconds.

void make_page(const TemporaryFolder& folder, const Arguments& arguments) {
    const Outcome outcome = run(folder, joined({"report", "-o", "p.html", "-q"}, arguments));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
}

void check_console(Browser& browser) {
    for (const std::string& line : browser.console()) {
        FAIL_CHECK("the console has: " << line);
    }
}

/// Waits until the view has not been drawn for longer than it waits for the last picture.
void wait_until_still(Browser& browser) {
    browser.eval_later(
        "let drawn = -1;"
        "const look = () => {"
        "  const now = document.documentElement.dataset.drawn;"
        "  if (now === drawn) { done(); } else { drawn = now; setTimeout(look, 700); }"
        "};"
        "look();");
}

PngImage picture_of(Browser& browser, const TemporaryFolder& folder) {
    wait_until_still(browser);
    browser.take_picture("view", folder / "view.png");
    return read_png(folder / "view.png");
}

bool is_blue(Pixel p) {
    return p.blue > p.red + 30 && p.blue > p.green;
}
/// The surface itself is nearly grey, and warmer than the background.
bool is_bare(Pixel p) {
    return p.red > 60 && p.red >= p.blue + 3 && p.red < p.blue + 30;
}
bool is_orange(Pixel p) {
    return p.red > p.green + 25 && p.green > p.blue + 25;
}

template <class Is>
double part_of(const PngImage& image, const Is& is) {
    return static_cast<double>(std::count_if(image.pixels.begin(), image.pixels.end(), is)) /
           static_cast<double>(image.pixels.size());
}

double difference(const PngImage& a, const PngImage& b) {
    REQUIRE(a.pixels.size() == b.pixels.size());
    std::size_t other = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        other += a.pixels[i] != b.pixels[i];
    }
    return static_cast<double>(other) / static_cast<double>(a.pixels.size());
}

/// Returns what the page reports of the sample that is chosen or pointed at; "" for what it does
/// not.
std::string told(Browser& browser, const std::string& name) {
    const Json value = browser.eval("const names = [...document.querySelectorAll('#sample dt')];"
                                    "const found = names.find(dt => dt.textContent === '" +
                                    name +
                                    "');"
                                    "return found ? found.nextSibling.textContent : '';");
    return value.get<std::string>();
}

void click(Browser& browser, const std::string& id) {
    browser.eval("document.getElementById('" + id + "').click();");
}

void slide_to(Browser& browser, std::size_t count) {
    browser.eval("const slider = document.getElementById('shown'); slider.value = " +
                 std::to_string(count) + "; slider.dispatchEvent(new Event('input'));");
}

} // namespace

TEST_CASE("a page shows disks on a surface, and neither fetches nor complains") {
    const TemporaryFolder folder;
    make_page(folder, {kMesh, "-n", "400"});
    Browser browser;
    browser.open(folder / "p.html");
    const PngImage all = picture_of(browser, folder);
    const double blue = part_of(all, is_blue), bare = part_of(all, is_bare);
    CHECK(blue > 0.05);
    // Disks of samples that leave hardly any room cover about half of a surface.
    CHECK(blue / (blue + bare) > 0.35);
    CHECK(blue / (blue + bare) < 0.7);
    CHECK(part_of(all, is_orange) == 0); // None overlap.
    CHECK(browser.eval("return performance.getEntriesByType('resource').length;") == 0);
    CHECK(browser.eval("return document.getElementById('view-message').hidden;") == true);
    CHECK(browser.eval("return document.querySelectorAll('svg').length;") == 3);
    CHECK(browser.eval("return document.getElementById('spectrum').hidden;") == true);
    check_console(browser);
}

TEST_CASE("layers and the slider show what they say") {
    const TemporaryFolder folder;
    make_page(folder, {kMesh, "-n", "400"});
    Browser browser;
    browser.open(folder / "p.html");
    const auto count =
        browser.eval("return Number(document.getElementById('shown').max);").get<std::size_t>();
    CHECK(count ==
          tools::read_samples([&] {
              REQUIRE(run(folder, {"sample", kMesh, "-n", "400", "-o", "a.ply"}).status == 0);
              return folder / "a.ply";
          }())
              .rows.size());
    const double all = part_of(picture_of(browser, folder), is_blue);
    slide_to(browser, count / 2);
    CHECK(contains(browser.eval("return document.getElementById('shown-text').textContent;")
                       .get<std::string>(),
                   "first " + std::to_string(count / 2)));
    const double half = part_of(picture_of(browser, folder), is_blue);
    CHECK(half / all == doctest::Approx(0.5).epsilon(0.25));
    slide_to(browser, 0);
    CHECK(part_of(picture_of(browser, folder), is_blue) < 0.01 * all);
    slide_to(browser, count);
    click(browser, "show-disks");
    CHECK(part_of(picture_of(browser, folder), is_blue) < 0.01 * all);
    click(browser, "show-disks");
    click(browser, "show-surface");
    const PngImage disks = picture_of(browser, folder);
    CHECK(part_of(disks, is_bare) < 0.02);
    CHECK(part_of(disks, is_blue) > 0.9 * all); // And those behind.
    check_console(browser);
}

TEST_CASE("what is told of the sample pointed at is what the file has") {
    const TemporaryFolder folder;
    make_page(folder, {kMesh, "-n", "400"});
    REQUIRE(run(folder, {"sample", kMesh, "-n", "400", "-o", "a.ply"}).status == 0);
    const tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    Browser browser;
    browser.open(folder / "p.html");
    const PngImage before = picture_of(browser, folder);
    std::set<std::string> found;
    for (int x = -300; x <= 300; x += 60) {
        for (int y = -60; y <= 60; y += 60) {
            browser.move_to("view", x, y);
            browser.eval_later("requestAnimationFrame(() => requestAnimationFrame(done));");
            const std::string sample = told(browser, "Sample");
            if (sample.empty()) {
                continue;
            }
            found.insert(sample);
            CAPTURE(sample);
            CHECK(told(browser, "Face") ==
                  std::to_string(samples.rows.at(std::stoul(sample)).face));
            CHECK(std::stod(told(browser, "In D")) >= 1);
            CHECK(std::stod(told(browser, "In D")) < 2);
        }
    }
    CHECK(found.size() > 5);
    // One that is given by number, is marked, and has that of its nearest, which are as far apart.
    browser.eval("const number = document.getElementById('number'); number.value = 7;"
                 "number.dispatchEvent(new Event('input'));");
    browser.move_to("figures-heading", 0, 0);
    CHECK(told(browser, "Sample") == "7");
    CHECK(told(browser, "Face") == std::to_string(samples.rows[7].face));
    check_console(browser);
}

TEST_CASE("the view turns by mouse and by keys, and comes back") {
    const TemporaryFolder folder;
    make_page(folder, {kMesh, "-n", "400", "--view", "20,30"});
    Browser browser;
    browser.open(folder / "p.html");
    const PngImage first = picture_of(browser, folder);
    browser.move_to("view", -100, 100);
    browser.drag("view", 100, 150);
    browser.move_to("figures-heading", 0, 0);
    const PngImage turned = picture_of(browser, folder);
    CHECK(difference(first, turned) > 0.1);
    browser.eval("document.getElementById('view').focus();");
    browser.press("\xEE\x80\x91"); // Home.
    CHECK(difference(first, picture_of(browser, folder)) < 0.01);
    browser.press("\xEE\x80\x92"); // Arrow to the left.
    CHECK(difference(first, picture_of(browser, folder)) > 0.02);
    click(browser, "reset");
    const double near = part_of(first, is_blue) + part_of(first, is_bare);
    browser.scroll("view", -500);
    browser.move_to("figures-heading", 0, 0);
    const PngImage zoomed = picture_of(browser, folder);
    CHECK(part_of(zoomed, is_blue) + part_of(zoomed, is_bare) > 1.1 * near);
    check_console(browser);
}

TEST_CASE("a page fits a phone, by day and by night, and its times add up") {
    const TemporaryFolder folder;
    make_page(folder, {kMesh, "-n", "200", "--harmonics", "30"});
    for (const char* const scheme : {"light", "dark"}) {
        CAPTURE(scheme);
        Browser browser;
        browser.emulate(360, 740, scheme);
        browser.open(folder / "p.html");
        CHECK(browser.eval("return window.innerWidth;") == 360);
        CHECK(browser.eval("return document.documentElement.scrollWidth;") == 360);
        // WCAG asks for 4.5 between text and what is behind it.
        CHECK(browser
                  .eval("const light = color => {"
                        "  const [r, g, b] = color.match(/[0-9.]+/g).map(v => v / 255)"
                        "    .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);"
                        "  return 0.2126 * r + 0.7152 * g + 0.0722 * b;"
                        "};"
                        "const behind = element => {"
                        "  const color = getComputedStyle(element).backgroundColor;"
                        "  return color === 'rgba(0, 0, 0, 0)' ? behind(element.parentElement)"
                        "    : color;"
                        "};"
                        "return Math.min(...[...document.querySelectorAll("
                        "  'p, h1, h2, h3, th, td, dt, figcaption, label, span, b, pre, button')]"
                        "  .filter(element => element.textContent.trim() && element.offsetParent)"
                        "  .map(element => {"
                        "    const a = light(getComputedStyle(element).color) + 0.05;"
                        "    const b = light(behind(element)) + 0.05;"
                        "    return Math.max(a / b, b / a);"
                        "  }));")
                  .get<double>() >= 4.5);
        CHECK(browser.eval("return document.querySelectorAll('#time-chart text.name').length;") ==
              11);
        check_console(browser);
    }
}

TEST_CASE("without WebGL the page says so and tells the rest") {
    const TemporaryFolder folder;
    make_page(folder, {"builtin:cube", "-n", "100"});
    Browser browser({"--disable-3d-apis"});
    browser.open(folder / "p.html");
    const auto message = browser.eval("return document.getElementById('view-message').textContent;")
                             .get<std::string>();
    CHECK(contains(message, "WebGL"));
    CHECK(browser.eval("return document.querySelectorAll('#sample-figures tr').length;") > 5);
    CHECK(browser.eval("return document.querySelectorAll('svg').length;") == 3);
    check_console(browser);
}

TEST_CASE("ten thousand samples on seventy thousand triangles open at once and turn") {
    const TemporaryFolder folder;
    make_page(folder, {"builtin:showpiece:135", "-n", "10000"});
    Browser browser;
    browser.open(folder / "p.html");
    const auto load = browser.eval("return performance.now();").get<double>();
    CHECK(load < kLongestLoad);
    const Json frames =
        browser.eval_later("const view = document.getElementById('view');"
                           "const drawn = () => Number(document.documentElement.dataset.drawn);"
                           "const begin = performance.now(), before = drawn();"
                           "const turn = () => {"
                           "  view.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}));"
                           "  const seconds = (performance.now() - begin) / 1000;"
                           "  if (seconds < 4) { requestAnimationFrame(turn); }"
                           "  else { done((drawn() - before) / seconds); }"
                           "};"
                           "turn();");
    CHECK(frames.get<double>() > kMinFrames);
    MESSAGE("opened in " << load << " ms, turned at " << frames.get<double>()
                         << " frames per second");
    CHECK(part_of(picture_of(browser, folder), is_blue) > 0.05);
    check_console(browser);
}

} // namespace geodisk::test
