// SPDX-License-Identifier: MIT
// A plugin that does nothing, with the sensor of the string's: what MuJoCo takes to ask it.

#include <mujoco/mujoco.h>

mjPLUGIN_LIB_INIT(diabolo_empty) {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = "diabolo.empty";
  plugin.capabilityflags = mjPLUGIN_PASSIVE | mjPLUGIN_SENSOR;
  plugin.needstage = mjSTAGE_ACC;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.nsensordata = [](const mjModel*, int, int) { return 6; };
  plugin.compute = [](const mjModel*, mjData*, int, int) {};
  mjp_registerPlugin(&plugin);
}
