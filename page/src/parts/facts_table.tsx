import type { ComponentChildren } from 'preact';

// A table of values: the first cell of a row names it. Without columns it has no head.
export function FactsTable({ columns, rows, shown = (name) => name }: { columns?: readonly string[] | undefined; rows: readonly (readonly string[])[]; shown?: (name: string) => ComponentChildren }) {
  return (
    <table class="facts">
      {columns !== undefined && (
        <thead>
          <tr>
            <td />
            {columns.map((name) => (
              <th scope="col" key={name}>
                {name}
              </th>
            ))}
          </tr>
        </thead>
      )}
      <tbody>
        {rows.map(([name = '', ...values]) => (
          <tr key={name}>
            <th scope="row">{shown(name)}</th>
            {values.map((value, i) => (
              <td key={i}>{value}</td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
