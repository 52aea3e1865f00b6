// Italiano.
import type { DriverWords } from './en';

export const it: DriverWords = {
  part_driver: 'Driver',
  driverLesson:
    'Un transistor commuta ogni avvolgimento. La corrente non sale istantaneamente: segue la legge esponenziale i(t) = U/R · (1 − e^(−t·R/L)). Alle frequenze di passo più alte non c’è tempo di raggiungere la corrente nominale, perciò la coppia cala.',
  stagesLesson:
    'Una tensione maggiore con una resistenza in serie riduce la costante di tempo L/R, ma la resistenza scalda. Un chopper usa la tensione maggiore senza resistenza: diseccita l’avvolgimento alla corrente nominale e lo eccita di nuovo quando la corrente scende sotto la sua banda. Assunti: L e la coppia di tenuta, che la fonte non indica, e 0,7 V sui diodi di ricircolo. Non inclusi: la tensione indotta e l’accoppiamento dei mezzi avvolgimenti.',
  saturation: 'Caduta del transistor, VCE(sat)',
  raisedSupply: 'Tensione maggiorata',
  seriesResistor: 'Resistenza in serie',
  chopperBand: 'Banda del chopper, frazione',
  fitSeries: 'Adatta la resistenza alla corrente nominale',
  currentOverTime: 'Corrente di un avvolgimento',
  switchedOff: 'spento',
  stage_plain: 'Sola alimentazione (L/R)',
  stage_series: 'Tensione maggiorata, resistenza in serie',
  stage_chopper: 'Tensione maggiorata, chopper',
  stagesTable: 'I tre stadi di pilotaggio a confronto',
  stageTitle: 'Stadio di pilotaggio',
  riseTo90: 'Salita al 90 %',
  mostCurrent: 'Picco',
  windingHeat: 'Avvolgimento',
  resistorHeat: 'Resistenza',
  transistorHeat: 'Transistor',
  baseTitle: 'Resistenza di base del Darlington',
  baseLesson:
    'Il Darlington (BDX53C, guadagno minimo 750) deve andare in saturazione. La base richiede la corrente di collettore divisa per il guadagno, aumentata del 20–30 %. Rimane la tensione base-emettitore di circa 1,4 V.',
  gainTitle: 'Guadagno hFE',
  logicVolts: 'Livello logico alto',
  baseEmitter: 'Tensione base-emettitore',
  reserveTitle: 'Margine, frazione',
  baseResistor: 'Resistenza di base',
  withReserve: 'con un margine del {percent} %',
  baseAmple: '{times} volte il necessario: abbondante. Copre un guadagno minore, una tensione base-emettitore maggiore e un livello logico più basso, e costa solo pochi milliampere.',
  baseTooLittle: '{times} volte il necessario: non basta per il margine.',
  heatWhileOn: 'Potenza dissipata in conduzione, VCE(sat) · I',
  warmerBy: 'Sovratemperatura senza dissipatore, in conduzione per metà del tempo',
};
