// Motors to choose from. Their data are those of machine files of this project: examples/machines/strong-router.toml and
// examples/troubles. A visitor with other motors writes them into the machine file.
export interface MotorKind {
  name: string;
  data: Record<string, number>;
}
const nema17 = { holding_torque_nm: 0.45, rated_current_a: 1.7, resistance_ohm: 1.5, inductance_mh: 2.8, rotor_inertia_g_cm2: 68 };
const nema23 = { holding_torque_nm: 1.9, rated_current_a: 2.8, resistance_ohm: 1.13, inductance_mh: 3.6, rotor_inertia_g_cm2: 480 };
const nema23small = { holding_torque_nm: 1.4, rated_current_a: 3.7, resistance_ohm: 0.95, inductance_mh: 1.9, rotor_inertia_g_cm2: 330 };
export const motorKinds: Record<string, MotorKind> = {
  'nema17-24v': { name: 'NEMA 17, 0.45 N·m, 1.7 A, 24 V', data: { ...nema17, supply_v: 24 } },
  'nema23-24v': { name: 'NEMA 23, 1.4 N·m, 3.7 A, 24 V', data: { ...nema23small, supply_v: 24 } },
  'nema23-36v': { name: 'NEMA 23, 1.9 N·m, 2.8 A, 36 V', data: { ...nema23, supply_v: 36 } },
  'nema23-48v': { name: 'NEMA 23, 1.9 N·m, 2.8 A, 48 V', data: { ...nema23, supply_v: 48 } },
};

// What a motor moves: the mass of the slide and its load, and the friction.
export interface MovedLoad {
  mass: number; // kg
  friction: number; // N
}
export const usualLoad: MovedLoad = { mass: 10, friction: 30 };

// The keys of [axis.X.torque]. The motion stays that of the machine file: the motors are only checked.
export const motorKeys = (kind: MotorKind, load: MovedLoad): Record<string, number | boolean> => ({
  ...kind.data,
  limits_motion: false,
  load_mass_kg: load.mass,
  friction_n: load.friction,
});
