#pragma once

#include "sim/inverter_model.hpp"
#include "sim/modbus_device.hpp"

namespace rvbench::sim {

/// The simulated inverter as Modbus meets it: its registers are those of inverter_table.
class InverterDevice final : public ModbusDevice {
 public:
  /// @param model  must outlive the device
  explicit InverterDevice(InverterModel& model) : model_(model) {}

  void note_request() override { model_.note_request(); }
  ModbusAnswer carry_out(const ModbusRequest& request) override;

 private:
  InverterModel& model_;
};

}  // namespace rvbench::sim
