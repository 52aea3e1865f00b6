// The head of a row in a table of axes: what the row has, and its unit, which is seen however narrow the page is.
export function RowHead({ title, unit }: { title: string; unit: string }) {
  return (
    <th scope="row">
      {title} {unit !== '' && <span class="unit">{unit}</span>}
    </th>
  );
}
