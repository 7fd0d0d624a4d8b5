#pragma once

#include <filesystem>
#include <optional>

namespace rvbench::hal {

/// Locks an open file for this program alone, by flock(): the kernel lets go of it when the last
/// descriptor of that opening is closed, however the program ends. Somebody who only looks, as
/// is_locked() does, is waited for.
/// @return 0, or errno: EWOULDBLOCK if another has it
int lock_alone(int descriptor) noexcept;

/// Whether a program has locked that file alone. Makes no file, and any number may look at once.
/// @return nothing if it is not there, or cannot be looked at
std::optional<bool> is_locked(const std::filesystem::path& file);

}  // namespace rvbench::hal
