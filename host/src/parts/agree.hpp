// Agreement: processes decide their parts of a surface until no decision of one changes another's.
//
// Dart throwing accepts a candidate if no accepted one before it is too close. Each process decides
// its own candidates that way, with the accepted ones of its neighbours as they were last told.
// Decisions that agree everywhere are those of one process on the whole surface: by induction over
// dart order, each process knows the right samples before a candidate, so it decides it rightly.
// The same induction shows that an end is reached: with each exchange at least the first wrong
// decision is put right for good.
#pragma once

#include <cstdint>
#include <functional>

#include <geodisk/exchange.hpp>
#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

#include "parts/darts.hpp"
#include "parts/part.hpp"

namespace geodisk {

/// Cost of an agreement.
struct AgreementReport {
    std::uint32_t rounds = 0;   ///< Exchanges, the same for all processes.
    std::uint64_t messages = 0; ///< Messages to neighbours.
    std::uint64_t bytes = 0;    ///< Their size.
};

/// Returns the accepted ones of own candidates, in dart order. `near` are the samples of
/// neighbours, in dart order; null before any is known.
using Decide = std::function<Result<Darts>(const Darts* near)>;

/// Returns the accepted ones of own candidates on which all processes agree. All call it. Errors:
/// the first one of `decide` on any process, on all of them; those of the exchange.
GEODISK_API Result<Darts> agree(Exchange& exchange, const Part& part, const Decide& decide,
                                AgreementReport& report);

} // namespace geodisk
