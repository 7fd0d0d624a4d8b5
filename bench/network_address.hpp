#pragma once

#include <string>
#include <vector>

namespace rvbench::bench {

/// The numeric addresses that a host is known by: "192.168.3.30", "fe80::1"; of "localhost" and of
/// "::1", "127.0.0.1". As it is named where it cannot be resolved: no such name, or no network.
///
/// Time   a name server that does not answer may take seconds; a number takes none
/// Limits  addresses of one host on several networks are several hosts here
std::vector<std::string> addresses_of(const std::string& host);

}  // namespace rvbench::bench
