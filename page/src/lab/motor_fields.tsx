// The motor, its drive and its load, for the pages of torque and loops.
import type { JSX } from 'preact';
import type { Motor } from './core';
import { NumberField, Segments } from './shared';
import { change, view } from './state';
import type { LabView } from './view';
import { say } from './words';

const kgM2PerGCm2 = 1e-7;

// A loop and a torque curve show themselves best with a friction of their own.
export type FrictionField = 'friction' | 'drag';

export function motorOf(now: LabView, friction: FrictionField): Motor {
  return {
    stepsPerTurn: 200,
    rotorInertia: now.gcm2 * kgM2PerGCm2,
    holdingTorque: now.hold,
    current: now.amps,
    resistance: now.ohms,
    inductance: now.mh / 1000,
    supply: now.volts,
    resistive: now.resistive,
    loadInertia: now.loadgcm2 * kgM2PerGCm2,
    friction: now[friction],
  };
}

export function MotorFields({ friction }: { friction: FrictionField }): JSX.Element {
  const now = view.value;
  const number = (name: 'hold' | 'amps' | 'ohms' | 'mh' | 'gcm2' | 'volts' | 'loadgcm2' | FrictionField, label: string, unit: string, step: number, from: number, to: number): JSX.Element => (
    <NumberField label={label} unit={unit} value={now[name]} step={step} from={from} to={to} onChange={(value) => change({ [name]: value })} />
  );
  return (
    <>
      <Segments
        label={say('regulation')}
        value={now.resistive ? 'resistive' : 'chopper'}
        options={[{ value: 'chopper', words: say('chopper') }, { value: 'resistive', words: say('resistive') }]}
        onChange={(value) => change({ resistive: value === 'resistive' })}
      />
      <div class="lab-pair">
        {number('hold', say('holdingTorque'), 'N·m', 0.05, 0.001, 100)}
        {number('amps', say('current'), 'A', 0.1, 0.01, 50)}
        {number('ohms', say('resistance'), 'Ω', 0.1, 0.01, 500)}
        {number('mh', say('inductance'), 'mH', 0.1, 0.01, 500)}
        {number('volts', say('supply'), 'V', 1, 1, 400)}
        {number('gcm2', say('rotorInertia'), 'g·cm²', 1, 0.1, 1e5)}
        {number('loadgcm2', say('loadInertia'), 'g·cm²', 1, 0, 1e6)}
        {number(friction, say('friction'), 'N·m', 0.01, 0, 100)}
      </div>
    </>
  );
}
