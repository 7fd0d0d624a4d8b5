# Fails where a file includes a room that it may not see.
#   cmake -DROOT=<source dir> -P tests/layering.cmake
set(may_hal       hal)
set(may_sequences sequences hal)
set(may_analysis  analysis hal/types)
set(may_sim       sim hal)
set(may_bench     bench sequences analysis hal)
set(may_tests/proof/seal tests/proof/seal hal)  # whoever hides physics shares none
foreach(file IN ITEMS  # the only users of sim
    candidate_probes.cpp candidate_probes.hpp channel_fault.cpp channel_fault.hpp
    envelope_features.cpp envelope_features.hpp envelope_records.cpp envelope_records.hpp envelope_twin.cpp envelope_twin.hpp
    order_between.hpp order_campaign.cpp order_campaign.hpp order_choice.cpp order_choice.hpp order_features.cpp order_features.hpp order_pushes.cpp
    order_pushes.hpp order_records.hpp order_twin.cpp
    order_twin.hpp planned_inputs.cpp planned_inputs.hpp plant_family.cpp plant_family.hpp programme_cells.cpp programme_cells.hpp
    rig_factory.cpp served_bench.cpp served_bench.hpp sim_world.cpp sim_world.hpp standstill.cpp standstill.hpp time_records.cpp time_records.hpp time_twin.cpp time_twin.hpp tpa_simulation.cpp twin.cpp twin.hpp twin_candidates.cpp
    twin_candidates.hpp twin_check.cpp twin_check.hpp
    commands/check_command.cpp commands/devices_command.cpp commands/explain_command.cpp
    commands/simulate_command.cpp
    benchmarks/plant_engine.cpp benchmarks/simulation.cpp
    benchmarks/virtual_robot.cpp)
  set(may_bench/${file} ${may_bench} sim)
endforeach()

# The simulator reads the manuals for itself: it shares no register or frame table with the drivers.
set(never_sim "hal/modbus/|hal/can/(can_frames|slcan)")
# Device libraries stay behind .cpp files; analysis has no I/O, no clock and no threads of its own.
set(device_headers "<(modbus/|linux/can|hdf5|matio|FLAC/|sys/socket|iio[.]h|comedi|MQTT)")
set(never_system_analysis "<(fstream|iostream|cstdio|chrono|thread|mutex|future|filesystem)>")

set(bad "")
foreach(room IN ITEMS hal sequences analysis sim bench tests/proof/seal)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${room}/*.hpp ${ROOT}/${room}/*.cpp)
  foreach(file IN LISTS files)
    set(may ${may_${room}})
    if(DEFINED may_${file})
      set(may ${may_${file}})
    endif()
    if(file MATCHES "^hal/types/")
      set(may hal/types)
    endif()
    list(JOIN may "|" allowed)
    file(STRINGS ${ROOT}/${file} includes REGEX "^#include ")
    foreach(line IN LISTS includes)
      if(line MATCHES "^#include \"")
        if(NOT line MATCHES "^#include \"(${allowed})/" OR
           (DEFINED never_${room} AND line MATCHES "${never_${room}}"))
          string(APPEND bad "  ${file}: ${line}\n")
        endif()
      elseif((file MATCHES "\\.hpp$" AND line MATCHES "${device_headers}") OR
             (DEFINED never_system_${room} AND line MATCHES "${never_system_${room}}"))
        string(APPEND bad "  ${file}: ${line}\n")
      endif()
    endforeach()
  endforeach()
endforeach()
if(bad)
  message(FATAL_ERROR "layering broken:\n${bad}")
endif()
