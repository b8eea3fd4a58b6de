// Estimates of how long a run takes.
#include <doctest/doctest.h>

#include "program/time_estimate.hpp"

namespace geodisk::tools {
namespace {

TEST_CASE("what is left of a run follows from two seconds of its work, once it is warm") {
    TimeEstimate time;
    time.note(3, 0); // Candidates are drawn.
    time.note(4, 0.01);
    time.note(4.9, 0.1);
    time.note(6, 0.15);
    CHECK_FALSE(time.left());
    time.note(8.9, 0.3);
    REQUIRE(time.left());
    CHECK(*time.left() == doctest::Approx(14));
    const auto whole = time.long_run();
    REQUIRE(whole);
    CHECK(*whole == doctest::Approx(22.9));
    CHECK_FALSE(time.long_run()); // Once is enough.
}

TEST_CASE("a long run of which nothing is done yet is told of, and its time once it is known") {
    TimeEstimate time;
    time.note(5, 0.01);
    time.note(19, 0.01);
    CHECK_FALSE(time.is_long_already());
    time.note(21, 0.01);
    CHECK_FALSE(time.long_run());
    CHECK(time.is_long_already());
    CHECK_FALSE(time.is_long_already());
    time.note(30, 0.02);
    REQUIRE(time.left());
    const auto whole = time.long_run();
    REQUIRE(whole);
    CHECK(*whole > 60);
    CHECK_FALSE(time.is_long_already());
}

TEST_CASE("what passes before the work begins is no part of it") {
    TimeEstimate time;
    time.wait(22.5); // The driver compiles.
    time.note(22.5, 0);
    CHECK_FALSE(time.is_long_already());
    time.note(23.5, 0.01);
    CHECK(time.seconds() == 1);
    CHECK_FALSE(time.is_long_already());
    time.note(43, 0.01);
    CHECK(time.is_long_already());
}

TEST_CASE("a small part of the work says little of the rest") {
    TimeEstimate time(0.1);
    time.note(1, 0.1);
    time.note(3, 0.12);
    time.note(9, 0.15);
    CHECK_FALSE(time.left());
    time.note(13, 0.22);
    REQUIRE(time.left());
    CHECK(*time.left() == doctest::Approx(78));
}

TEST_CASE("runs that are soon done are no long ones") {
    TimeEstimate time;
    time.note(0.5, 0.1);
    time.note(4, 0.8);
    REQUIRE(time.left());
    CHECK(*time.left() == doctest::Approx(1));
    CHECK_FALSE(time.long_run());
}

} // namespace
} // namespace geodisk::tools
