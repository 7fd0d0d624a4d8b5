#include "sim/free_modbus.hpp"

#include <modbus/modbus.h>

namespace rvbench::sim {

void FreeModbus::operator()(_modbus* context) const { modbus_free(context); }

}  // namespace rvbench::sim
