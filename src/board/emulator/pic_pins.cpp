#include "pic_pins.hpp"

namespace passo {

PicPins pins_of(PicFollower board) {
  PicPins pins = {.cycle = 200,
                  .inputs = {{"clock.x", {"porta0"}},
                             {"clock.y", {"porta1"}},
                             {"clock.z", {"porta2"}},
                             {"direction.x", {"porta3"}},
                             {"direction.y", {"porta4"}},
                             {"direction.z", {"porta5"}},
                             {"relay", {"porte0"}},
                             {"button", {"portb3", false}}},
                  .outputs = {{"windings.x", {"portd", {4, 5, 6, 7}}},
                              {"windings.y", {"portc", {7, 4, 5, 6}}},
                              {"windings.z", {"portc", {2, 3, 0, 1}}},
                              {"relay", {"portd", {0}}},
                              {"indicator.relay", {"porte", {2}}}},
                  .rows = {4, 5, 6, 7},
                  .columns = {0, 1, 2}};
  if (board == PicFollower::at_20_mhz) {
    pins.outputs.insert({{"indicator.automatic", {"portd", {1}}}, {"indicator.manual", {"portd", {2}}}});
    return pins;
  }
  pins.cycle = 1000;
  pins.inputs["button"] = {"porte1", false};
  pins.outputs.insert({{"led.0", {"portb", {0}}},
                       {"led.1", {"portd", {1}, false}},
                       {"led.2", {"portd", {2}, false}},
                       {"led.3", {"portd", {3}, false}}});
  pins.rows = {2, 3, 4, 6};
  pins.columns = {1, 7, 5};
  return pins;
}

}  // namespace passo
