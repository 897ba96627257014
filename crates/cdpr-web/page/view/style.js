// How a cable is drawn: its tension decides the colour, slack or not.

import { viridis } from "../charts/scale.js";

/**
 * @param {{tension: number, slack: boolean, limit: string|null}} cable of the engine's answer
 * @param {{range: number, faded: boolean, selected: boolean}} options
 *   `range`: tension at the top of the scale [N]
 * @returns {{color: number[]|null, hasEdge: boolean, mark: "ink"|"warn"|null}}
 *   colour from 0 to 1, `null` for the palette's colour of faded cables; whether it has a dark edge; the
 *   palette's colour of its mark
 */
export function cableStyle(cable, { range, faded, selected }) {
  const isMarked = Boolean(cable.limit) && !faded;
  return {
    color: faded ? null : viridis(cable.tension / range),
    hasEdge: !faded && !cable.slack,
    mark: selected ? "ink" : isMarked ? "warn" : null,
  };
}
