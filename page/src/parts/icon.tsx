// Icons as strokes in a square of 24. They stand beside words, never instead of them.
const shapes = {
  run: 'M7 4v16l13-8z',
  jog: 'M12 3v18M3 12h18M12 3l-3 3m3-3 3 3M12 21l-3-3m3 3 3-3M3 12l3-3m-3 3 3 3M21 12l-3-3m3 3-3 3',
  files: 'M6 3h8l5 5v13H6zM14 3v5h5',
  console: 'M3 5h18v14H3zM7 9l3 3-3 3M12 15h5',
  machine: 'M4 21h16M6 21V5h12v3M12 5v7m-2 0h4l-2 4zM6 8h3',
  plug: 'M9 3v5m6-5v5M6 8h12v3a6 6 0 0 1-12 0zM12 17v4',
  pins: 'M7 7h10v10H7zM10 7V3m4 4V3m-4 14v4m4-4v4M7 10H3m4 4H3m14-4h4m-4 4h4',
  cam: 'M4 20l10-10m-2-4 6 6-3 3-6-6zM16 4l4 4',
  lab: 'M9 3h6M10 3v6L4.5 19a1.4 1.4 0 0 0 1.2 2h12.6a1.4 1.4 0 0 0 1.2-2L14 9V3M7 15h10',
  hold: 'M8 4v16M16 4v16',
  stop: 'M5 5h14v14H5z',
  resume: 'M5 4v16M9 4v16l11-8z',
  done: 'M4 13l5 5L20 6',
  reset: 'M4 12a8 8 0 1 0 3-6.2M4 4v5h5',
  warn: 'M12 3 2 20h20zM12 10v4m0 3v.01',
  bad: 'M8 3h8l5 5v8l-5 5H8l-5-5V8zM12 8v5m0 3v.01',
  calm: 'M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18M8 12l3 3 5-6',
  lost: 'M3 3l18 18M5 12a10 10 0 0 1 4-3M2 9a14 14 0 0 1 5-3m4-1a14 14 0 0 1 11 4m-6 4a10 10 0 0 1 3 2M8.500 15.500a5 5 0 0 1 7 0M12 19v.01',
  view: 'M4 7h10M18 7h2M4 17h2M10 17h10M14 4v6M6 14v6',
  help: 'M9 9a3 3 0 1 1 4 3c-1 .5-1 1-1 2m0 3v.01M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18',
  close: 'M6 6l12 12M18 6 6 18',
  home: 'M4 11l8-7 8 7M6 10v10h12V10M10 20v-6h4v6',
  turned: 'M4 20h16M4 20L17 7M13 20a10 10 0 0 0-3-6.500M17 7h-5m5 0v5',
  zero: 'M12 3v5m0 8v5M3 12h5m8 0h5M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8',
  plus: 'M12 5v14M5 12h14',
  minus: 'M5 12h14',
  search: 'M10 4a6 6 0 1 0 0 12 6 6 0 0 0 0-12m5 11 6 6',
  upload: 'M12 16V4M7 9l5-5 5 5M4 20h16',
  trash: 'M4 7h16M9 7V4h6v3M6 7l1 14h10l1-14',
  probe: 'M12 3v11M8 10l4 4 4-4M3 20h18M7 20v-3h10v3',
  up: 'M12 20V5M5 12l7-7 7 7',
  frame: 'M4 4h4M16 4h4v4M20 16v4h-4M8 20H4v-4M4 8V4M9 9h6v6H9z',
} as const;

export type IconName = keyof typeof shapes;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true" focusable="false">
      <path d={shapes[name]} />
    </svg>
  );
}
