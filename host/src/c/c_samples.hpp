// Samples of the C API.
#pragma once

#include <memory>

#include <geodisk/geodisk.h>
#include <geodisk/request.hpp>
#include <geodisk/runner.hpp>

#include "c/c_domain.hpp"

/// Immutable, and never copied.
struct geodisk_samples {
    std::shared_ptr<const geodisk::c::DomainState> of;
    geodisk::SampleSet set;
    geodisk::RequestedSet found{}; ///< Results of a request besides its set.
};
