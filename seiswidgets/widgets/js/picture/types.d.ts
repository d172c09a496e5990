// The traits of LivePicture in section_view/live_picture.py, as the browser receives them.

import type { AnyModel } from "@anywidget/types";
import type { StageState, TrianglesState } from "./live_chain.js";
import type { Picture } from "./picture.js";

export type Grid = {
  origin: [number, number];
  step: [number, number];
  metres: [number, number];
  shape: [number, number];
  tolerance: number;
};

export type TextureState = {
  id: number;
  shape: [number, number];
  rows: number;
  overview: { shape: [number, number]; data: DataView };
};

export type PictureTraits = {
  grid: Grid;
  texture: TextureState;
  stages: StageState[];
  triangles: TrianglesState[];
  frame: number | null;
  frames: number;
  colours: { palette: DataView; factor: number };
  deformation: { palette: DataView; span: number; opacity: number };
  changing: boolean;
  picture: Picture | null;
  revision: number;
  bare?: boolean; // while nothing but the section is to be seen
};

export type PictureModel = AnyModel<PictureTraits>;
