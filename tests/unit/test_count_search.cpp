// The search for the distance that gives a count.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <geodisk/count_search.hpp>

namespace geodisk::tools {
namespace {

struct Found {
    std::uint64_t count;
    std::uint32_t tries;
    double distance; ///< Distance of the best try; 0 for none.
};

/// Follows the search from a distance, where `count_at(distance)` samples come out.
template <class CountAt>
Found follow(CountSearch search, double distance, const CountAt& count_at) {
    Found found{};
    for (;;) {
        const std::uint64_t count = count_at(distance);
        const auto next = search.note(distance, count);
        if (search.is_nearest()) {
            found.count = count;
            found.distance = distance;
        }
        if (!next) {
            found.tries = search.tries();
            return found;
        }
        REQUIRE(*next > 0);
        distance = *next;
    }
}

template <class CountAt>
Found search(double wanted, double distance, const CountAt& count_at) {
    return follow(CountSearch(wanted), distance, count_at);
}

template <class CountAt>
Found search_exact(std::uint64_t count, double distance, const CountAt& count_at) {
    return follow(CountSearch::exact(count), distance, count_at);
}

std::uint64_t rounded(double count) {
    return static_cast<std::uint64_t>(std::lround(count));
}

TEST_CASE("a count that is near is not searched for") {
    const Found found = search(1000, 0.1, [](double) { return 1049u; });
    CHECK(found.tries == 1);
    CHECK(found.count == 1049);
}

TEST_CASE("counts by area, by length and by parts are found in a few tries") {
    for (const double wanted : {5.0, 30.0, 1000.0, 1e6}) {
        for (const double first : {0.01, 0.7, 1.3, 30.0}) {
            CAPTURE(wanted);
            CAPTURE(first);
            const auto by_area = [&](double d) { return rounded(wanted / (d * d)); };
            const auto by_length = [&](double d) { return rounded(wanted / d); };
            // As many as parts however large the distance is, and more by area.
            const auto by_parts = [&](double d) { return rounded(wanted * (0.8 + 0.2 / (d * d))); };
            for (const Found& found :
                 {search(wanted, first, by_area), search(wanted, std::sqrt(first), by_length),
                  search(wanted, std::sqrt(first), by_parts)}) {
                CHECK(std::abs(static_cast<double>(found.count) - wanted) <=
                      std::max(0.05 * wanted, 1.0));
            }
        }
    }
}

TEST_CASE("a count that no distance gives ends with the nearest") {
    // A step between 900 and 1,100.
    const auto count_at = [](double d) { return d < 1 ? 1100u : 900u; };
    const Found below = search(1000, 0.5, count_at);
    CHECK(below.tries == 7);
    CHECK((below.count == 1100 || below.count == 900));
    const Found few = search(3, 1, [](double) { return 10u; });
    CHECK(few.tries <= 2);
    CHECK(few.count == 10);
}

TEST_CASE("a second try finds what the first shows") {
    // Along thin parts; on an area with fewer samples than expected, or a few more.
    const auto by_length = [](double d) { return rounded(1000 / d); };
    const auto by_area = [](double d) { return rounded(1000 / (d * d)); };
    for (const double first : {0.5, 0.7}) {
        CHECK(search(1000, first, by_length).tries == 2);
    }
    for (const double first : {0.97, 1.1, 1.3, 2.0}) {
        CHECK(search(1000, first, by_area).tries == 2);
    }
    // As many small parts as wanted, and a large one.
    const auto by_parts = [](double d) { return rounded(800 + 200 / (d * d)); };
    CHECK(search(1000, 0.5, by_parts).tries <= 4);
}

TEST_CASE("few samples are near by chance, which the second try does not make up for") {
    CountSearch search(30);
    const auto next = search.note(1, 32);
    REQUIRE(next);
    CHECK(*next > 1.01);
    CHECK(*next < std::sqrt(32.0 / 30.0));
}

TEST_CASE("one of few samples more is near, one more than one is not") {
    CHECK(search(10, 1, [](double) { return 11u; }).tries == 1);
    CHECK(search(1, 1, [](double d) { return d < 1.2 ? 2u : 1u; }).count == 1);
}

TEST_CASE("an exact search gives enough and at most 1 % more") {
    for (const std::uint64_t count : {1u, 7u, 30u, 99u, 100u, 1000u, 1000000u}) {
        for (const double first : {0.3, 0.9, 0.99, 1.0, 1.01, 1.1, 3.0}) {
            CAPTURE(count);
            CAPTURE(first);
            const auto wanted = static_cast<double>(count);
            const auto by_area = [&](double d) { return rounded(wanted / (d * d)); };
            const auto by_length = [&](double d) { return rounded(wanted / d); };
            // Samples that are there at any distance, and a wave of chance.
            const auto with_others = [&](double d) {
                return rounded(wanted * (0.4 + 0.6 / (d * d) + 0.01 * std::sin(40 * d)));
            };
            for (const Found& found :
                 {search_exact(count, first, by_area), search_exact(count, first, by_length),
                  search_exact(count, first, with_others)}) {
                CHECK(found.count >= count);
                CHECK(found.count <= count + count / 100);
                CHECK(found.tries <= 6);
            }
        }
    }
}

TEST_CASE("an exact search keeps the largest distance with enough samples") {
    // A step between 900 and 1,100.
    const Found step = search_exact(1000, 0.97, [](double d) { return d < 1 ? 1100u : 900u; });
    CHECK(step.tries == 6);
    CHECK(step.count == 1100);
    CHECK(step.distance > 0.98);
    CHECK(step.distance < 1);
    // One in each of 10 parts, however large the distance is.
    const Found parts = search_exact(3, 1, [](double) { return 10u; });
    CHECK(parts.tries <= 2);
    CHECK(parts.count == 10);
}

TEST_CASE("an exact search has no best try where too few samples fit") {
    const Found none = search_exact(1000, 1, [](double) { return 0u; });
    CHECK(none.distance == 0);
    CHECK(none.tries == 2);
    CHECK(search_exact(100000, 1, [](double) { return 1u; }).tries == 2);
    CHECK(search_exact(1, 1, [](double) { return 0u; }).distance == 0);
    // It goes on where a smaller distance gives no more by chance, as long as few are expected.
    for (const std::uint64_t count : {2u, 5u, 100u}) {
        CAPTURE(count);
        const auto wanted = static_cast<double>(count);
        const double room = std::sqrt(wanted / 30000);
        const Found found =
            search_exact(count, 1, [&](double d) { return d > room ? 1u : rounded(wanted); });
        CHECK(found.count == count);
        CHECK(found.distance > 0);
    }
    // It goes on beyond six tries until there are enough.
    const Found late = search_exact(1000, 64, [](double d) { return d > 0.1 ? 0u : 1000u; });
    CHECK(late.distance == 0);
    const Found few =
        search_exact(1000, 20, [](double d) { return rounded(std::max(0.0, 1010 - 100 * d)); });
    CHECK(few.count >= 1000);
    CHECK(few.tries <= 12);
}

} // namespace
} // namespace geodisk::tools
