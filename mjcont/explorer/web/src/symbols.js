// Markers of special points: shape by kind, readable without colour.

const CIRCLE = "M-4.5,0A4.5,4.5 0 1,0 4.5,0A4.5,4.5 0 1,0 -4.5,0Z";
const SHAPES = {
  LP: CIRCLE,
  HB: "M-4.2,-4.2H4.2V4.2H-4.2Z",
  BP: "M0,-5.6L5.2,3.6H-5.2Z",
  CP: "M0,-5.8L5.2,0L0,5.8L-5.2,0Z",
  BT: "M0,5.6L5.2,-3.6H-5.2Z",
  UZ: "M-4,0H4M0,-4V4",
  EP: "M0,-4V4",
  CO: "M-3.6,-3.6L3.6,3.6M-3.6,3.6L3.6,-3.6",
};
const OTHER = "M0,-5.4L5.1,-1.7L3.2,4.4H-3.2L-5.1,-1.7Z";

/** Return the path of the marker of a kind of point, about the origin. */
export function markerPath(kind) {
  return SHAPES[kind] ?? OTHER;
}
