// What a page holds of a packing, taken apart: grains, contacts, and colours for them.
const branchcrushData = (() => {
  "use strict";
  const STEPS = 65535;
  const VIRIDIS = ["440154", "481f70", "443983", "3b528b", "31688e", "287c8e", "21918c",
    "20a486", "35b779", "5ec962", "90d743", "c8e020", "fde725"].map(rgb);
  const GENERATIONS = ["c9ced6", "e8b04a", "c1440e", "5b1a4a"].map(rgb);
  const NONE = rgb("c9ced6");
  const MODES = {
    radius: { label: "radius", unit: "mm", factor: 1e3, none: "" },
    energy: { label: "stored energy", unit: "J", factor: 1, none: "none" },
    pressure: { label: "pressure of the grain", unit: "Pa", factor: 1, none: "none" },
    generation: { label: "generation", unit: "", factor: 1, none: "" },
  };
  const GENERATION_WORDS = ["first grain", "fragment", "its fragment", "further"];

  function rgb(hex) {
    return [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
  }

  // Numbers of 16 bits, little-endian whatever the machine is.
  function words(text) {
    const raw = atob(text), view = new DataView(new ArrayBuffer(raw.length));
    for (let k = 0; k < raw.length; k++) view.setUint8(k, raw.charCodeAt(k));
    return Uint16Array.from({ length: raw.length / 2 }, (_, k) => view.getUint16(2 * k, true));
  }

  // Equal ratios between steps; 0 is none.
  function decoded(codes, scale) {
    if (!scale) return new Float64Array(codes.length);
    const ratio = Math.log(scale[1] / scale[0]);
    return Float64Array.from(codes, (k) =>
      k ? scale[0] * Math.exp(ratio * (k - 1) / (STEPS - 1)) : 0);
  }

  function state(header, all, number) {
    const row = header.states[number], n = row.grains, scales = header.scales;
    let at = row.offset;
    const take = (count) => all.subarray(at, (at += count));
    const place = () => Float64Array.from(take(n), (k) => (2 * k / STEPS - 1) * row.span_m);
    const index = (count) => {
      const low = take(count);
      if (!row.wide) return low;
      const high = take(count);
      return Uint32Array.from(low, (k, m) => k + 65536 * high[m]);
    };
    const x = place(), y = place(), z = place();
    const radius = decoded(take(n), scales.radius), energy = decoded(take(n), scales.energy);
    const pressure = decoded(take(n), scales.pressure), generation = take(n);
    const i = index(row.contacts), j = index(row.contacts);
    const force = decoded(take(row.contacts), scales.force);
    const wallGrain = index(row.walls);
    const wallDirection = [0, 1, 2].map(() => Float64Array.from(take(row.walls), (k) => 2 * k / STEPS - 1));
    const wallForce = decoded(take(row.walls), scales.force);
    return { row, x, y, z, radius, energy, pressure, generation, i, j, force,
      wallGrain, wallDirection, wallForce };
  }

  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const cross = (u, v) => [0, 1, 2].map((k) =>
    u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
  // So many times each edge of the cell.
  const along = (cell, times) => [0, 1, 2].map((k) =>
    times[0] * cell[0][k] + times[1] * cell[1][k] + times[2] * cell[2][k]);
  const SIGNS = [-1, 1];
  const SHIFTS = [-1, 0, 1].flatMap((a) => [-1, 0, 1].flatMap((b) => [-1, 0, 1].map((c) => [a, b, c])));

  // Both ends of the twelve edges of a cell, about its middle.
  function box(cell) {
    const ends = [];
    for (let axis = 0; axis < 3; axis++)
      for (const a of SIGNS) for (const b of SIGNS) for (const c of SIGNS) {
        const times = [0, 0, 0];
        times[axis] = c / 2; times[(axis + 1) % 3] = a / 2; times[(axis + 2) % 3] = b / 2;
        ends.push(...along(cell, times));
      }
    return Float32Array.from(ends);
  }

  const volume = (cell) => dot(cell[0], cross(cell[1], cell[2]));

  // Edge of the cube of a cell's volume.
  function size(cell) {
    return Math.cbrt(Math.abs(volume(cell)));
  }

  // Width of a cell along a direction of unit length.
  function width(cell, direction) {
    return cell.reduce((sum, vector) => sum + Math.abs(dot(vector, direction)), 0);
  }

  // Returns the shortest image of a vector in a cell, and whether it is another one.
  function nearest(cell, periodic) {
    const reciprocal = [0, 1, 2].map((k) =>
      cross(cell[(k + 1) % 3], cell[(k + 2) % 3]).map((v) => v / volume(cell)));
    // Nothing is shorter than half of the least distance of two faces. Beyond it the image of rounded
    // shares need not be the shortest, in a cell that is much tilted.
    const sure = Math.min(...reciprocal.map((r) => 1 / dot(r, r))) / 4;
    const beside = SHIFTS.filter((shift) => shift.every((n, k) => !n || periodic[k]))
      .map((shift) => [shift, along(cell, shift)]);
    return (d) => {
      const jumps = reciprocal.map((r, k) => (periodic[k] ? -Math.round(dot(d, r)) : 0));
      const rounded = along(cell, jumps).map((v, k) => v + d[k]);
      if (dot(rounded, rounded) <= sure) return [rounded, jumps.some(Boolean)];
      let image = rounded, through = jumps.some(Boolean);
      for (const [shift, vector] of beside) {
        const other = rounded.map((v, k) => v + vector[k]);
        if (dot(other, other) < dot(image, image) * (1 - 1e-6))
          [image, through] = [other, shift.some((n, k) => n + jumps[k])];
      }
      return [image, through];
    };
  }

  // From the centre of the first grain to that of the second, through the face where they touch;
  // the half beyond a face is drawn from the other side.
  function chains(header, s) {
    const ends = [], widths = [], shortest = nearest(s.row.cell_m, header.periodic);
    const largest = header.scales.force ? header.scales.force[1] : 1;
    const add = (x, y, z, dx, dy, dz, force) => {
      ends.push(x, y, z, x + dx, y + dy, z + dz);
      widths.push(force / largest);
    };
    const p = [s.x, s.y, s.z];
    s.i.forEach((a, k) => {
      const b = s.j[k], [d, through] = shortest(p.map((c) => c[b] - c[a]));
      if (!through) return add(s.x[a], s.y[a], s.z[a], ...d, s.force[k]);
      const h = d.map((v) => v / 2);
      add(s.x[a], s.y[a], s.z[a], ...h, s.force[k]);
      add(s.x[b], s.y[b], s.z[b], ...h.map((v) => -v), s.force[k]);
    });
    // To the surface of the grain, which touches the wall.
    s.wallGrain.forEach((a, k) =>
      add(s.x[a], s.y[a], s.z[a], ...s.wallDirection.map((n) => n[k] * s.radius[a]), s.wallForce[k]));
    return { ends: Float32Array.from(ends), force: Float32Array.from(widths) };
  }

  function viridis(t) {
    const at = Math.min(Math.max(t, 0), 1) * (VIRIDIS.length - 1);
    const k = Math.min(Math.floor(at), VIRIDIS.length - 2), part = at - k;
    return VIRIDIS[k].map((v, c) => Math.round(v + part * (VIRIDIS[k + 1][c] - v)));
  }

  // Energies and pressures range over decades, so that their colours do by their logarithm.
  function colours(header, s, mode) {
    const out = new Uint8Array(3 * s.row.grains), scale = header.scales[mode];
    s[mode].forEach((value, k) => {
      let colour = NONE;
      if (mode === "generation") colour = GENERATIONS[Math.min(value, GENERATIONS.length - 1)];
      else if (value > 0) colour = viridis(place(mode, value, scale));
      out.set(colour, 3 * k);
    });
    return out;
  }

  function place(mode, value, [low, high]) {
    if (high <= low) return 0.5;
    if (mode === "radius") return 1 - 0.85 * value / high;
    // The lowest hundred thousandth of a range shows no more than its end.
    const from = Math.max(low, high * 1e-5);
    return Math.log(value / from) / Math.log(high / from);
  }

  // What the colour bar says: stops of its gradient, and the values at its ends and between.
  function bar(header, mode) {
    const scale = header.scales[mode];
    if (!scale) return null;
    const { factor } = MODES[mode];
    const [low, high] = mode === "radius" ? scale : [Math.max(scale[0], scale[1] * 1e-5), scale[1]];
    const values = [0, 0.5, 1].map((t) =>
      mode === "radius" ? low + t * (high - low) : low * Math.exp(t * Math.log(high / low)));
    const below = mode !== "radius" && scale[0] < low ? "≤ " : "";
    const stops = Array.from({ length: 13 }, (_, k) => {
      const t = k / 12;
      const value = mode === "radius" ? low + t * (high - low) : low * Math.exp(t * Math.log(high / low));
      return `rgb(${viridis(place(mode, value, scale)).join(" ")})`;
    });
    return { stops, values: values.map((v, k) => (k ? "" : below) + number(v * factor)) };
  }

  function number(value) {
    if (value === 0) return "0";
    const text = value.toPrecision(3);
    if (!text.includes("e") && Math.abs(value) >= 1e-3 && Math.abs(value) < 1e5) return String(Number(text));
    const power = Math.floor(Math.log10(Math.abs(value)) + 1e-9);
    const digits = String(-power).replace("-", "");
    const up = [...digits].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("");
    return `${(value / 10 ** power).toPrecision(2)}·10${power < 0 ? "⁻" : ""}${up}`;
  }

  return { words, state, box, size, width, chains, colours, bar, number, MODES, GENERATIONS, GENERATION_WORDS, NONE };
})();
