// English: the words of the lab's part Driver.
export const en = {
  part_driver: 'Driver',
  driverLesson:
    'A transistor switches each winding. The current does not jump to its value: it rises by i(t) = U/R · (1 − e^(−t·R/L)). At higher step rates there is no time left to reach the rated current, so the torque falls.',
  stagesLesson:
    'A raised supply with a series resistor shortens the time constant L/R, but the resistor heats. A chopper uses the raised supply without a resistor: it switches the winding off at the rated current, and on again when the current has fallen below its band. Assumed: L and the holding torque, because the source does not give them; a drop of 0.7 V at the diodes. Not included: the induced voltage and the coupling of the half windings.',
  saturation: 'Transistor drop, VCE(sat)',
  raisedSupply: 'Raised supply voltage',
  seriesResistor: 'Series resistor',
  chopperBand: 'Chopper band, fraction',
  fitSeries: 'Fit the series resistor to the rated current',
  currentOverTime: 'Current of one winding',
  switchedOff: 'off',
  stage_plain: 'Supply alone (L/R)',
  stage_series: 'Raised supply, series resistor',
  stage_chopper: 'Raised supply, chopper',
  stagesTable: 'The three driver stages compared',
  stageTitle: 'Driver stage',
  riseTo90: 'Rise to 90 %',
  mostCurrent: 'Peak',
  windingHeat: 'Winding',
  resistorHeat: 'Resistor',
  transistorHeat: 'Transistor',
  baseTitle: 'Base resistor of the Darlington',
  baseLesson:
    'The Darlington (BDX53C, gain at least 750) must saturate. Its base needs the collector current divided by the gain, with a reserve of 20 to 30 %. The base-emitter voltage of about 1.4 V remains.',
  gainTitle: 'Current gain hFE',
  logicVolts: 'Logic high level',
  baseEmitter: 'Base-emitter voltage',
  reserveTitle: 'Reserve, fraction',
  baseResistor: 'Base resistor',
  withReserve: 'with {percent} % reserve',
  baseAmple: '{times} times what is needed: ample. It covers a lower gain, a higher base-emitter voltage and a weaker logic level, and costs only milliamperes.',
  baseTooLittle: '{times} times what is needed: not enough for the reserve.',
  heatWhileOn: 'Heat while on, VCE(sat) · I',
  warmerBy: 'Temperature rise without heat sink, on half of the time',
};

export type DriverWords = Record<keyof typeof en, string>;
