// The registers of the H-100: F163 is the address, coil 0x49 runs forward, 0x4A backward and 0x4B stops; register
// 0x0201 is the frequency in 0.1 Hz; input register 0 is the output frequency, 2 the output current, 10 the fault. As
// in the communication chapter of the H100 User Manual (Changrong), with which grblHAL (Plugins_spindle, h100.c) and
// FluidNC (H100Protocol.cpp) agree for speed, run and stop.
#include "passo/spindle/vfd_table.hpp"

namespace passo {

const VfdTable& h100_table() {
  static const VfdTable table = [] {
    constexpr std::uint16_t on = 0xFF00;
    VfdTable h100;
    h100.name = "H-100";
    h100.speed = {.function = 6, .address = 0x0201, .scale = 10, .is_in_hertz = true};
    h100.forward = {.function = 5, .address = 0x49, .value = on};
    h100.reverse = VfdCommand{.function = 5, .address = 0x4A, .value = on};
    h100.stop = {.function = 5, .address = 0x4B, .value = on};
    h100.actual_speed = {.function = 4, .address = 0, .scale = 10, .is_in_hertz = true};
    h100.current = VfdRegister{.function = 4, .address = 2, .scale = 10};
    h100.fault = VfdRegister{.function = 4, .address = 10};
    h100.fault_texts = {{1, "overcurrent during acceleration (OC1)"},
                        {2, "overcurrent during deceleration (OC2)"},
                        {3, "overcurrent at constant speed (OC3)"},
                        {4, "overvoltage during acceleration (OV1)"},
                        {5, "overvoltage during deceleration (OV2)"},
                        {6, "overvoltage at constant speed (OV3)"},
                        {7, "undervoltage (LV)"},
                        {8, "the drive is too hot (OH)"},
                        {9, "the motor is overloaded (I.t)"},
                        {10, "communication time-out (CB)"},
                        {11, "wrong parameter (Err)"},
                        {12, "the drive is overloaded (oL)"},
                        {13, "ground fault (tE)"}};
    return h100;
  }();
  return table;
}

}  // namespace passo
