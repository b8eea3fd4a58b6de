// Classes of samples that were read from a file.
#pragma once

#include "files/samples/sample_file.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk/options/constraint_options.hpp"
#include "geodisk/options/mask_options.hpp"

namespace geodisk::tools {

/// Returns the classes that the header of the file `path` has; none without. Throws
/// UserError(bad_input) if they are none.
ClassTable classes_in_header(const SampleFile& samples);

/// Throws UserError(bad_input) unless each sample has one of `count` classes.
void check_classes(const SampleFile& samples, std::size_t count);

/// Throws UserError(bad_input) if options are for single classes, and a sample has none or the file
/// does not have so many.
void check_class_options(const SampleFile& samples, const MaskOptions& mask,
                         const ConstraintOptions& constraints);

} // namespace geodisk::tools
