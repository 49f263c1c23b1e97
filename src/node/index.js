// Few charts, no flipped or degenerate triangle, proven in exact arithmetic.

export { Atlas, ChartType, Initialize, withOptions } from './atlas.js';
export { unwrapBytes } from './bytes.js';
export { unwrapd } from './document.js';
export { InvalidInput, InvalidOptions, NoValidResult, UnwrapdError } from './errors.js';
