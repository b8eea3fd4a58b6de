// Standard input, output and error, which whoever starts a program may have closed.
#pragma once

namespace geodisk::tools {

/// Gives numbers of closed streams to nothing, so that no file gets them and receives what is meant
/// for a stream. Writing to standard output then fails. To be called first.
void occupy_closed_streams();

} // namespace geodisk::tools
