// Français.
import type { DriverWords } from './en';

export const fr: DriverWords = {
  part_driver: 'Étage de puissance',
  driverLesson:
    'Un transistor commute chaque enroulement. Le courant ne s’établit pas d’un coup : il suit i(t) = U/R · (1 − e^(−t·R/L)). Aux fréquences de pas élevées, le temps manque pour atteindre le courant nominal, et le couple diminue.',
  stagesLesson:
    'Une tension plus élevée avec une résistance série réduit la constante de temps L/R, mais la résistance chauffe. Un hacheur utilise cette tension sans résistance : il coupe l’enroulement au courant nominal et le réalimente quand le courant est descendu sous sa bande. Supposés : L et le couple de maintien, que la source n’indique pas, et 0,7 V aux diodes de roue libre. Non compris : la tension induite et le couplage des demi-enroulements.',
  saturation: 'Chute du transistor, VCE(sat)',
  raisedSupply: 'Tension d’alimentation élevée',
  seriesResistor: 'Résistance série',
  chopperBand: 'Bande du hacheur, fraction',
  fitSeries: 'Adapter la résistance série au courant nominal',
  currentOverTime: 'Courant d’un enroulement',
  switchedOff: 'coupé',
  stage_plain: 'Alimentation seule (L/R)',
  stage_series: 'Tension élevée, résistance série',
  stage_chopper: 'Tension élevée, hacheur',
  stagesTable: 'Les trois étages de puissance comparés',
  stageTitle: 'Étage de puissance',
  riseTo90: 'Montée à 90 %',
  mostCurrent: 'Crête',
  windingHeat: 'Enroulement',
  resistorHeat: 'Résistance',
  transistorHeat: 'Transistor',
  baseTitle: 'Résistance de base du Darlington',
  baseLesson:
    'Le Darlington (BDX53C, gain d’au moins 750) doit être saturé. Sa base demande le courant de collecteur divisé par le gain, avec une réserve de 20 à 30 %. La tension base-émetteur reste d’environ 1,4 V.',
  gainTitle: 'Gain en courant hFE',
  logicVolts: 'Niveau logique haut',
  baseEmitter: 'Tension base-émetteur',
  reserveTitle: 'Réserve, fraction',
  baseResistor: 'Résistance de base',
  withReserve: 'avec {percent} % de réserve',
  baseAmple: '{times} fois le nécessaire : largement suffisant. Cela couvre un gain plus faible, une tension base-émetteur plus élevée et un niveau logique plus bas, et ne coûte que des milliampères.',
  baseTooLittle: '{times} fois le nécessaire : insuffisant pour la réserve.',
  heatWhileOn: 'Puissance dissipée en conduction, VCE(sat) · I',
  warmerBy: 'Échauffement sans dissipateur, en conduction la moitié du temps',
};
