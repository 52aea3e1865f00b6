// The jobs of `passo cam` as forms. A field that is left empty takes the default, which stands in it.
import type { Key } from '../core/language';
import { fromMm, lengthUnit } from '../core/units';
import { usualClearance, usualDepth } from '../machine/machine_file';

export interface Field {
  option: string;
  title: Key;
  kind: 'text' | 'flag' | 'choice' | 'file';
  usual?: string;
  ofMachine?: 'clearance' | 'depth'; // the machine file may say otherwise
  choices?: readonly (readonly [string, Key])[];
  without?: Key; // what counts where nothing is chosen
}
export interface Form {
  job: string;
  title: Key;
  files: string; // what the file dialog offers
  most?: number; // files at once
  withoutFiles?: string; // an option that needs no drawing
  fields: readonly Field[];
  more?: readonly Field[]; // that few need
  parts?: readonly string[]; // jobs that it needs; their options are those of their own forms
  decides?: readonly string[]; // options of these jobs that it sets itself
}

const text = (option: string, title: Key, usual = ''): Field => ({ option, title, kind: 'text', usual });
// Lengths that the machine file may have as its usual ones.
const clearance = (usual: string): Field => ({ ...text('clearance', 'make.clearance', usual), ofMachine: 'clearance' });
const depth = (usual: string): Field => ({ ...text('depth', 'make.depth', usual), ofMachine: 'depth' });
const flag = (option: string, title: Key): Field => ({ option, title, kind: 'flag' });
const choice = (option: string, title: Key, without: Key, choices: readonly (readonly [string, Key])[]): Field => ({ option, title, kind: 'choice', without, choices });
const mirror = choice('mirror', 'make.mirror', 'make.mirror.not', [['x', 'make.mirror.x'], ['y', 'make.mirror.y']]);
const zero = choice('zero', 'make.zero', 'make.zero.drawn', [['lower-left', 'make.zero.low']]);
const ends = [clearance('2mm'), text('spindle', 'make.spindle', '12000'), zero, mirror];
const milled = [text('feed', 'make.feed', '200mm'), text('plunge-feed', 'make.plunge', '60mm'), ...ends, flag('conventional', 'make.conventional')];
const units = choice('units', 'make.units', 'make.units.mm', [['cm', 'make.units.cm'], ['inch', 'make.units.inch']]);
const input = choice('input', 'make.input', 'make.as.file', [['mm', 'make.units.mm'], ['cm', 'make.units.cm'], ['inch', 'make.units.inch']]);
const seldom = [units, input, text('scale', 'make.scale'), text('mirror-at', 'make.mirror.at'), text('align', 'make.align.holes'), text('park', 'make.park', '0,0')];
const join = text('join', 'make.join', '0.1mm');
const sheet = text('sheet', 'make.sheet');
const layer = text('layer', 'make.layer');

// Of what is cut out along a line.
const cutOut = [
  depth('-1.8mm'),
  text('step', 'make.step', '0.5mm'),
  text('tabs', 'make.tabs', '0'),
  text('tab-width', 'make.tabs.width', '2mm'),
  text('tab-height', 'make.tabs.height', '0.6mm'),
  text('ramp', 'make.ramp', '0'),
  text('lead', 'make.lead'),
  flag('dog-bones', 'make.dogbones'),
];
const drawings = '.svg,.dxf,.hpgl,.plt';

export const forms: readonly [Form, ...Form[]] = [
  {
    job: 'profile',
    title: 'make.profile',
    files: drawings,
    fields: [
      choice('side', 'make.side', 'make.side.part', [['outside', 'make.side.outside'], ['inside', 'make.side.inside'], ['on', 'make.side.on']]),
      text('tool', 'make.tool', '2mm'),
      ...cutOut,
      layer,
      ...milled,
    ],
    more: [join, text('tab', 'make.tab'), sheet, ...seldom],
  },
  {
    job: 'pocket',
    title: 'make.pocket',
    files: drawings,
    fields: [
      text('tool', 'make.tool', '3mm'),
      depth('-3mm'),
      text('step', 'make.layers', '1mm'),
      text('step-over', 'make.over', '40'),
      text('ramp', 'make.ramp', '5'),
      layer,
      ...milled,
    ],
    more: [text('engagement', 'make.engagement', '0'), join, sheet, ...seldom],
  },
  {
    job: 'engrave',
    title: 'make.engrave',
    files: `${drawings},.ttf,.otf,.lff,.jhf`,
    withoutFiles: 'text',
    fields: [
      text('text', 'make.text'),
      { option: 'font', title: 'make.font', kind: 'file', without: 'make.font.usual', choices: [['simplex', 'make.font.simplex']] },
      text('height', 'make.letters', '10mm'),
      choice('text-align', 'make.align', 'make.align.left', [['middle', 'make.align.middle'], ['right', 'make.align.right']]),
      text('around', 'make.around'),
      text('angle', 'make.angle', '60'),
      text('tip', 'make.tip', '0mm'),
      text('tool', 'make.widest', '6mm'),
      text('depth', 'make.deepest'),
      text('clear', 'make.clear.tool'),
      ...milled,
    ],
    more: [
      flag('on-line', 'make.on.line'),
      choice('inlay', 'make.inlay', 'make.inlay.none', [['pocket', 'make.inlay.pocket'], ['plug', 'make.inlay.plug']]),
      text('inlay-depth', 'make.inlay.depth', '4mm'),
      text('glue-gap', 'make.inlay.glue', '0.5mm'),
      text('saw-gap', 'make.inlay.saw', '1mm'),
      text('margin', 'make.inlay.margin', '5mm'),
      text('clear-step', 'make.clear.step', '1mm'),
      text('step', 'make.carve.step'),
      text('arc', 'make.arc'),
      text('turn', 'make.turned', '0'),
      text('line-space', 'make.line.space', '1.6'),
      join,
      layer,
      sheet,
      ...seldom,
    ],
  },
  {
    job: 'drill',
    title: 'make.drill',
    files: '.drl,.xln,.exc,.txt,.dxf,.kicad_pcb',
    fields: [
      depth('-2mm'),
      text('tools', 'make.tools'),
      text('drill', 'make.drill.one'),
      text('mill', 'make.drill.mill'),
      text('peck', 'make.peck'),
      text('feed', 'make.plunge', '100mm'),
      ...ends,
      flag('plain', 'make.plain'),
    ],
    more: [
      text('tolerance', 'make.tolerance.drill', '0.05mm'),
      text('mill-step', 'make.step', '0.5mm'),
      text('mill-feed', 'make.mill.feed', '150mm'),
      text('align-drill', 'make.align.drill', '3mm'),
      choice('zeros', 'make.zeros', 'make.as.file', [['leading', 'make.zeros.leading'], ['trailing', 'make.zeros.trailing']]),
      layer,
      ...seldom,
    ],
  },
  {
    job: 'isolate',
    title: 'make.isolate',
    files: '.gbr,.gtl,.gbl,.dxf,.top,.bot,.kicad_pcb',
    fields: [
      text('tool', 'make.tools.width', '0.2mm'),
      text('v', 'make.v'),
      text('depth', 'make.depth', '-0.05mm'),
      text('passes', 'make.passes', '1'),
      text('width', 'make.free'),
      flag('clear', 'make.clear'),
      { option: 'edge', title: 'make.edge', kind: 'file', without: 'make.edge.none' },
      ...milled,
    ],
    more: [flag('voronoi', 'make.voronoi'), text('overlap', 'make.overlap', '50'), text('tolerance', 'make.tolerance.copper', '0.004mm'), layer, ...seldom],
  },
  {
    job: 'outline',
    title: 'make.outline',
    files: '.gbr,.gko,.gm1,.dxf,.svg,.kicad_pcb',
    fields: [
      text('tool', 'make.tool', '2mm'),
      ...cutOut,
      ...milled,
    ],
    more: [text('tab', 'make.tab'), join, layer, ...seldom],
  },
  {
    job: 'board',
    title: 'make.board',
    files: '.zip,.gbr,.gtl,.gbl,.gko,.gm1,.gts,.gbs,.gto,.gbo,.gtp,.gbp,.top,.bot,.drl,.xln,.exc,.txt,.kicad_pcb',
    fields: [
      choice('turn', 'make.mirror', 'make.mirror.x', [['y', 'make.mirror.y']]),
      text('margin', 'make.board.margin', '10mm'),
      text('pins', 'make.board.pins', '5mm'),
      flag('probe-holes', 'make.board.probe'),
      text('heights', 'make.board.heights'),
    ],
    parts: ['drill', 'isolate', 'outline'],
    decides: ['zero', 'mirror', 'mirror-at', 'align', 'edge', 'layer', 'tab', 'zeros'],
  },
  {
    job: 'relief',
    title: 'make.relief',
    files: '.png,.tif,.tiff,.stl,.csv,.xyz',
    fields: [
      text('width', 'make.width', '100mm'),
      text('depth', 'make.relief.depth', '3mm'),
      text('cutter', 'make.cutter', 'ball:3'),
      choice('way', 'make.way', 'make.way.rows', [
        ['columns', 'make.way.columns'],
        ['both', 'make.way.both'],
        ['spiral', 'make.way.spiral'],
        ['contours', 'make.way.contours'],
      ]),
      text('scallop', 'make.scallop', '0.02mm'),
      text('rough', 'make.rough'),
      text('rest', 'make.rest'),
      flag('invert', 'make.invert'),
      flag('mirror', 'make.relief.mirror'),
      text('feed', 'make.feed', '1000mm'),
      text('plunge', 'make.plunge', '300mm'),
      clearance('5mm'),
      text('spindle', 'make.spindle'),
    ],
    more: [
      text('length', 'make.length'),
      choice('origin', 'make.zero', 'make.zero.low', [['lower-right', 'make.origin.lower.right'], ['upper-left', 'make.origin.upper.left'], ['upper-right', 'make.origin.upper.right'], ['center', 'make.origin.center']]),
      text('gamma', 'make.gamma', '1'),
      choice('channel', 'make.channel', 'make.channel.luminance', [['alpha', 'make.channel.alpha']]),
      text('margin', 'make.rim', '0mm'),
      choice('margin-level', 'make.rim.level', 'make.rim.bottom', [['top', 'make.rim.top']]),
      text('pitch', 'make.pitch'),
      text('step', 'make.rows.step'),
      text('steep', 'make.steep', '45'),
      choice('moves', 'make.moves', 'make.moves.arcs', [['lines', 'make.moves.lines']]),
      text('removal', 'make.removal'),
      text('feed-most', 'make.feed.most'),
      text('tolerance', 'make.tolerance', '0.01mm'),
      text('overrun', 'make.overrun'),
      choice('entry', 'make.entry', 'make.entry.ramp', [['plunge', 'make.entry.plunge']]),
      text('ramp-angle', 'make.ramp', '5'),
      choice('rough-way', 'make.rough.way', 'make.way.rows', [['offsets', 'make.rough.way.offsets']]),
      text('rough-step', 'make.rough.step'),
      text('rough-down', 'make.rough.down', '2mm'),
      text('rough-stock', 'make.rough.stock', '0.3mm'),
      text('rough-feed', 'make.rough.feed'),
      text('rough-removal', 'make.rough.removal'),
      text('rest-step', 'make.rest.step'),
      text('rest-least', 'make.rest.least', '0.05mm'),
      text('rest-feed', 'make.rest.feed'),
      text('rest-removal', 'make.rest.removal'),
    ],
  },
  {
    job: 'wire',
    title: 'make.wire',
    files: `${drawings},.dat`,
    most: 2,
    fields: [
      choice('axes', 'make.wire.axes', 'make.wire.axes.needed', [['XY', 'make.wire.xy'], ['XYUV', 'make.wire.xyuv']]),
      choice('keep', 'make.wire.keep', 'make.side.inside', [['outside', 'make.side.outside'], ['line', 'make.side.on']]),
      text('kerf', 'make.wire.kerf', '1mm'),
      text('feed', 'make.feed', '200mm'),
      text('most-feed', 'make.wire.most'),
      text('span', 'make.wire.span'),
      text('width', 'make.wire.width'),
      text('chord', 'make.wire.chord'),
      text('right-at', 'make.wire.right', '0,0'),
      text('right-turn', 'make.wire.turn', '0'),
      text('block', 'make.wire.block'),
      text('lead', 'make.wire.lead', '10mm'),
      text('heat', 'make.wire.heat'),
      zero,
    ],
    more: [text('block-at', 'make.wire.block.at'), text('tolerance', 'make.tolerance', '0.01mm'), join, layer, units, input, text('scale', 'make.scale')],
  },
];

// Texts that are no lengths. Cutters are lengths within words: they have their units themselves.
const noLengths = new Set([
  'text', 'layer', 'angle', 'arc', 'turn', 'line-space', 'spindle', 'tabs', 'ramp', 'ramp-angle', 'step-over', 'engagement', 'overlap', 'passes',
  'gamma', 'scale', 'steep', 'removal', 'rough-removal', 'rest-removal', 'v', 'cutter', 'rough', 'rest', 'heights', 'right-turn', 'heat',
]);
const isLength = (field: Field): boolean => field.kind === 'text' && !noLengths.has(field.option);
const bare = /^[-+]?(\d+\.?\d*|\.\d+|\d+\/\d+)$/;

// Bare numbers are in the unit of the page. They are sent with it, and keep it where the page shows another one later.
export function withUnit<T extends string | boolean>(field: Field, value: T): T | string {
  if (typeof value !== 'string' || !isLength(field)) return value;
  return value
    .split(',')
    .map((one) => (bare.test(one.trim()) ? `${one.trim()}${lengthUnit()}` : one.trim()))
    .join(',');
}
// What the machine file says of it, as it is sent.
export function ofMachine({ ofMachine: which }: Field): string | undefined {
  const mm = which === 'clearance' ? usualClearance.value : which === 'depth' ? usualDepth.value : undefined;
  return mm === undefined ? undefined : `${mm}mm`;
}
// What counts where nothing is filled in, in the unit of the page.
export function usualOf(field: Field): string {
  const usual = ofMachine(field) ?? field.usual ?? '';
  const mm = /^(-?[\d.]+)mm$/.exec(usual)?.[1];
  return mm === undefined || lengthUnit() === 'mm' ? usual : `${Number(fromMm(Number(mm)).toPrecision(3))}${lengthUnit()}`;
}

const kindOf = (name: string): string => (/\.[a-z0-9_]+$/i.exec(name)?.[0] ?? '').toLowerCase();
const takes = (form: Form, kind: string): boolean => kind !== '' && form.files.split(',').includes(kind);

// The form that takes such files: the one at hand if it does. Several files of a board make a whole board, as a zip does.
export function formFor(names: readonly string[], atHand: Form): Form {
  const kinds = names.map(kindOf);
  const fits = (form: Form): boolean => kinds.every((kind) => takes(form, kind));
  const several = forms.find((form) => form.parts !== undefined && kinds.length > 1 && fits(form) && kinds.some((kind) => kind !== '.txt'));
  return [several ?? atHand, ...forms].find(fits) ?? [atHand, ...forms].find((form) => takes(form, kinds.at(-1) ?? '')) ?? atHand;
}
// Whether a file is a drawing or a picture, and no G-code.
export const isDrawing = (name: string): boolean => kindOf(name) !== '.txt' && forms.some((form) => takes(form, kindOf(name)));
