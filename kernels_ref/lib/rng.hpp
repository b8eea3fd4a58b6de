// The random words of the candidates, the same function as in the library.
#pragma once

#include "geodisk/detail/philox.hpp"

namespace geodisk::ref {

using geodisk::philox;

} // namespace geodisk::ref
