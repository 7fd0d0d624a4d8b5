#pragma once

#include <filesystem>
#include <string>

#include "bench/factory/outbox.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// What the factory is told of a judged run: JSON with ResultMetaData and ResultContent, their
/// fields named after ResultDataType and ResultMetaDataType, enumerations and states as numbers.
/// ResultContent holds one entry: verdict, findings, limits and the indicators of each point, as
/// verdict.json has them. It is plain JSON, not the encoding of OPC 10000-6.
///
/// Left out is FileFormat, which tells of files that a server of OPC UA hands out: there is none.
/// ResultUri names the run's files on this computer.
///
/// @param step  what the factory calls this test (StepId); "": it has no name for it
/// @return what is due; bad_data if verdict.json is damaged or not the one that was hashed
/// Source  OPC 40001-101 (OPC UA for Machinery, Result Transfer) 1.01, 10.3 to 10.6
Result<OutboxEntry> result_message(const std::filesystem::path& root,
                                   const std::filesystem::path& folder, const std::string& step);

/// ResultId of the run as it was judged: of its folder and of the hash of its verdict.json, so the
/// same as often as it is asked for, and another one after the run was resumed to another verdict.
/// "" if the run has no hashes (yet).
std::string result_id_of(const std::filesystem::path& root, const std::filesystem::path& folder);

/// The payload as it goes out, with "PossibleDuplicate": whether an earlier sending may have come
/// through as well, though nobody acknowledged it.
std::string payload_to_send(const OutboxEntry& due);

}  // namespace rvbench::bench
