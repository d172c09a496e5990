// The traits of PointerLayer in section_view/pointer_layer.py, as the browser receives them.

import type { AnyModel } from "@anywidget/types";

/** A point on the section, in its units. */
export type SectionPoint = { x: number; z: number };

/** A point in css pixels, from the upper left corner of the plot area. */
export type Pixel = { x: number; y: number };

export type Axis = { title: string; pixels: number[]; labels: string[] };
export type Axes = { x: Axis; z: Axis; left: number; note: string };

/** Points are offsets from the origin, as 32-bit numbers; NaN interrupts the line. */
export type StrokeState = Pick<Stroke, "colour" | "width"> &
  Partial<Omit<Stroke, "points">> & { origin: [number, number]; points: DataView };

export type Stroke = {
  points: ([number, number] | null)[];
  colour: string;
  width: number;
  dots: boolean;
  dash: number[];
  label: string;
  chosen: number | null;
  joined: boolean;
};

export type Mark = {
  x: number;
  z: number;
  kind: "cutoff" | "held" | "cursor" | "finding";
  text?: string;
  colour: string;
  path?: string;
};

export type Shade = { href: string; window: number[]; opacity: number };

export type Mesh = { vertices: DataView; edges: DataView };

export type AffineMapState = { source: DataView; target: DataView; triangles: DataView; tolerance: number };

export type Traits = {
  axes: Partial<Axes>;
  window: number[];
  size: number[];
  strokes: StrokeState[];
  changed_strokes: (StrokeState & { index: number })[];
  marks: Mark[];
  rubber: [number, number][];
  mesh: Partial<Mesh>;
  mesh_opacity: number;
  shade?: Partial<Shade>; // none in handouts
  chain: AffineMapState[];
  carried: Partial<SectionPoint>;
  linked: Partial<SectionPoint>;
  hotkeys: string[];
  label: string;
  picture: string | null;
  restored: boolean;
  stage: number | null;
};

export type Model = AnyModel<Traits>;

export type MessageKind =
  | "press"
  | "drag"
  | "release"
  | "hover"
  | "leave"
  | "double"
  | "wheel"
  | "pinch"
  | "key"
  | "menu";
