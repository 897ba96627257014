// Statistics of the observations, as `cdpr study run` defines them.

/**
 * Mean, standard deviation (n - 1), extremes and quantiles of the observations that have a value.
 * @param {Array<number|null>} values
 */
export function summary(values) {
  const sorted = Float64Array.from(values.filter((value) => value !== null)).sort();
  const count = sorted.length;
  if (count === 0) return { count, failed: values.length };
  let mean = 0;
  for (const value of sorted) mean += value / count;
  let squares = 0;
  for (const value of sorted) squares += (value - mean) ** 2;
  return {
    count,
    failed: values.length - count,
    mean,
    std: count > 1 ? Math.sqrt(squares / (count - 1)) : 0,
    min: sorted[0],
    max: sorted[count - 1],
    q05: quantile(sorted, 0.05),
    q50: quantile(sorted, 0.5),
    q95: quantile(sorted, 0.95),
    sorted,
  };
}

/** The quantile of a sorted sample, linear between its values. */
export function quantile(sorted, p) {
  const place = (sorted.length - 1) * p;
  const k = Math.floor(place);
  const next = Math.min(k + 1, sorted.length - 1);
  return sorted[k] + (place - k) * (sorted[next] - sorted[k]);
}

/** Bins by the rule of Freedman and Diaconis (1981), 5 to 60 of them. */
export function bins({ sorted, min, max }) {
  const width = (2 * (quantile(sorted, 0.75) - quantile(sorted, 0.25))) / Math.cbrt(sorted.length);
  if (!(max > min) || !(width > 0)) return { edges: [min, max], counts: [sorted.length] };
  const count = Math.min(60, Math.max(5, Math.ceil((max - min) / width)));
  const counts = new Array(count).fill(0);
  for (const value of sorted)
    counts[Math.min(count - 1, Math.floor(((value - min) / (max - min)) * count))] += 1;
  return { edges: Array.from({ length: count + 1 }, (_, k) => min + ((max - min) * k) / count), counts };
}
