#pragma once

struct _modbus;  // libmodbus's modbus_t

namespace rvbench::sim {

/// Frees a context of libmodbus; its socket, which is one of its server's, stays open.
struct FreeModbus {
  void operator()(_modbus* context) const;
};

}  // namespace rvbench::sim
