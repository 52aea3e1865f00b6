// 简体中文。
import type { DriverWords } from './en';

export const zh: DriverWords = {
  part_driver: '驱动级',
  driverLesson:
    '每相绕组由一个晶体管开关。电流不会立即达到稳定值，而是按 i(t) = U/R · (1 − e^(−t·R/L)) 上升。步频较高时来不及达到额定电流，转矩因此下降。',
  stagesLesson:
    '提高电源电压并串联电阻可以减小时间常数 L/R，但电阻会发热。斩波驱动使用同样的高电压而不用电阻：电流达到额定值时关断绕组，降到电流带以下时再次接通。假定值：资料未给出的 L 和保持转矩，以及续流二极管压降 0.7 V。未计入：感应电动势和半绕组之间的耦合。',
  saturation: '晶体管压降 VCE(sat)',
  raisedSupply: '提高后的电源电压',
  seriesResistor: '串联电阻',
  chopperBand: '斩波电流带（比例）',
  fitSeries: '按额定电流选取串联电阻',
  currentOverTime: '一相绕组的电流',
  switchedOff: '关断',
  stage_plain: '仅电源（L/R）',
  stage_series: '高电压加串联电阻',
  stage_chopper: '高电压斩波',
  stagesTable: '三种驱动级的比较',
  stageTitle: '驱动级',
  riseTo90: '上升到 90 %',
  mostCurrent: '峰值',
  windingHeat: '绕组',
  resistorHeat: '电阻',
  transistorHeat: '晶体管',
  baseTitle: '达林顿管的基极电阻',
  baseLesson:
    '达林顿管（BDX53C，增益不低于 750）必须饱和导通。基极电流至少为集电极电流除以增益，再留 20 % 到 30 % 的余量。基极与发射极之间约有 1.4 V 压降。',
  gainTitle: '电流增益 hFE',
  logicVolts: '逻辑高电平',
  baseEmitter: '基极-发射极电压',
  reserveTitle: '余量（比例）',
  baseResistor: '基极电阻',
  withReserve: '留 {percent} % 余量',
  baseAmple: '为所需值的 {times} 倍：余量充足。增益偏低、基极-发射极电压偏高或逻辑电平偏低时仍能饱和，代价只是几毫安。',
  baseTooLittle: '为所需值的 {times} 倍：余量不足。',
  heatWhileOn: '导通时的功耗 VCE(sat) · I',
  warmerBy: '无散热片、导通时间占一半时的温升',
};
