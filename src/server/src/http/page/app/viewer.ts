// The two views: the shown file and the element under the pointer.

import { Box3, type Object3D, Sphere, type Texture as Image } from "three";
import type { Analysis } from "../analysis/analysis";
import type { Texture } from "../analysis/soup";
import { MEASURES } from "../analysis/distortion";
import { rangeOf } from "../analysis/statistics";
import { Gutters, levelsOf } from "../viewer/gutters";
import { imageOf } from "../viewer/image";
import { load, type Loaded } from "../viewer/loading";
import { SHADES, type Uniforms, uniformsBeside } from "../viewer/look";
import { Model } from "../viewer/model";
import type { Shown } from "../pull/beside";
import type { Relaxing } from "../viewer/relaxing";
import { pagesOf, Sheet } from "../viewer/sheet";
import { originsOf, soupOf } from "../viewer/soups";
import { lights, type Places, Stage } from "../viewer/stage";
import { color } from "../viewer/theme_color";
import type { View } from "../viewer/surface";
import { type Place, START } from "./address";
import { analyzed } from "./analyst";
import { byId } from "./dom";
import { Pointing } from "./pointing";
import { type Facts, type Source, uvsOf } from "./source";
import { modelOfJob, type Store } from "./store";

/** Shows files in both views. */
export class Viewer {
  readonly stage: Stage | null;
  readonly pointing: Pointing;
  model: Model | null = null;
  /** Analysis of the shown file, even without WebGL. */
  analysis: Analysis | null = null;
  /** Facts about the shown file. */
  facts: Facts | null = null;
  readonly #sheet = new Sheet();
  /** Another file beside, and its background. */
  #beside: { model: Model; uniforms: Uniforms; texture: Texture } | null = null;
  readonly #sheetBeside = new Sheet();
  /** Width of the surface in percent as the views have it. */
  #split = START.split;
  /** Numbers of requests to show a file, and one beside it, by which late answers are recognized and dropped. */
  #shown = 0;
  #shownBeside = 0;
  /** The model that the cameras look at. */
  #seen: string | null = null;
  #relaxing: Relaxing | null = null;
  #image: Image | null = null;
  readonly #gutters = new Gutters();
  readonly #guttersBeside = new Gutters();
  /** Callback for another file. */
  changed: () => void = () => {};

  constructor(readonly store: Store) {
    const beside = { solid: byId("solid-beside"), plane: byId("plane-beside") };
    const places = { canvas: byId<HTMLCanvasElement>("canvas"), solid: byId("solid"), plane: byId("plane"), beside };
    this.stage = stageOn(places);
    this.pointing = new Pointing(this, places);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.apply());
    store.show(() => this.apply());
  }

  get place(): Readonly<Place> {
    return this.store.place;
  }

  /** Shows a file. Resolves when both views show it; false if another file was requested since. */
  async show(source: Source): Promise<boolean> {
    const mine = ++this.#shown;
    delete byId("panes").dataset.shown;
    const loaded = await load(source);
    if (mine !== this.#shown) return false;
    if (this.stage) this.#preview(this.stage, loaded, source);
    const uvs = uvsOf(source, loaded, this.place.set);
    const soup = soupOf(loaded, uvs);
    if (!soup.parts.some(({ positions }) => positions.length)) throw new Error("The file has no triangles to show.");
    const analysis = await analyzed(soup);
    if (mine !== this.#shown) return false;
    this.facts = { source, ...uvs, texture: soup.texture, origins: originsOf(soup), missing: loaded.missing };
    this.#take(this.facts, loaded, analysis);
    return true;
  }

  /** Shows the file again with the UV set of the state. */
  async again(): Promise<void> {
    if (this.facts) await this.show(this.facts.source);
  }

  /** Shows another file beside, with the same looks and cameras, or none. Does nothing if another one was requested since. */
  async showBeside(source: Source | null): Promise<void> {
    const { stage } = this;
    const [mine, mineBeside] = [this.#shown, ++this.#shownBeside];
    if (!source && !this.#beside) return;
    const loaded = source && stage ? await load(source) : null;
    const uvs = source && loaded ? uvsOf(source, loaded, null) : null;
    const soup = loaded && uvs ? soupOf(loaded, uvs) : null;
    const analysis = soup && (await analyzed(soup));
    if (!stage || mine !== this.#shown || mineBeside !== this.#shownBeside) return;
    this.#beside?.model.dispose();
    this.#beside = null;
    if (loaded && uvs && soup && analysis) {
      const uniforms = uniformsBeside(stage.uniforms);
      this.#beside = { uniforms, texture: soup.texture, model: new Model(loaded, analysis, { set: uvs.set, aspect: soup.texture.width / soup.texture.height }, uniforms) };
    }
    byId("panes").classList.toggle("both", this.#beside !== null);
    stage.resize();
    this.apply();
    if (!stage.plane.isMoved) this.#framePlane();
    this.changed();
  }

  /** Shows nothing. */
  clear(): void {
    this.#shown += 1;
    this.calm();
    void this.showBeside(null);
    this.model?.dispose();
    this.model = this.analysis = this.facts = null;
    this.stage?.solid.turn(false);
    this.stage?.solid.show([], null);
    this.stage?.plane.show([]);
    this.stage?.redraw();
    this.changed();
  }

  /** Shows relaxing charts in place of UVs until another file is shown. */
  relax(relaxing: Relaxing, described: string): void {
    const { stage } = this;
    if (!stage) return;
    if (this.#relaxing !== relaxing) {
      this.calm();
      stage.plane.frame([0, 0, 1, 1]);
      this.#isFramed = false;
    }
    this.#relaxing = relaxing;
    byId("plane-note").textContent = "";
    byId("relaxing").textContent = described;
    stage.plane.show(relaxing.meshes);
    stage.redraw();
  }

  get isRelaxing(): boolean {
    return this.#relaxing !== null;
  }

  /** Ends the display of relaxing charts. */
  calm(): void {
    if (!this.#relaxing) return;
    this.stage?.plane.show([]);
    this.#relaxing.dispose();
    this.#relaxing = null;
    byId("relaxing").textContent = "";
  }

  /** Shows the scene alone until its analysis is ready. */
  #preview(stage: Stage, loaded: Loaded, source: Source): void {
    const bounds = boundsOf(loaded.scene);
    if (this.model || bounds.isEmpty()) return;
    stage.solid.show([loaded.scene, ...lights()], bounds);
    this.#look(stage, source);
    stage.redraw();
  }

  /** Aims the camera at another model: as it was left, or from the front. A model that was seen before is seen on as a
   * person left it. */
  #look({ solid }: Stage, { model, from, isTurning = false }: Source): void {
    const { camera } = this.place;
    if (this.#seen === model) return;
    this.#seen = model;
    this.#isFramed = false;
    solid.frame(from ?? (this.model?.isFlat ? [0, 0, 1] : undefined));
    solid.turn(isTurning && !camera);
    if (camera) solid.place = camera;
  }

  /** Frames the UVs unless a person has moved them. */
  #lookAtUvs({ plane }: Stage): void {
    if (!this.#isFramed && this.place.plane) plane.place = this.place.plane;
    else if (!plane.isMoved) this.#framePlane();
    this.#isFramed = true;
  }

  /** Set once the UVs of the seen model are framed. */
  #isFramed = false;

  /** Writes the cameras to the state, if a person has moved them, so that they are found again. */
  keepCameras(): void {
    const { stage } = this;
    if (!stage || !this.#seen || stage.solid.isTurning || !byId("panes").dataset.shown) return;
    const camera = stage.solid.isMoved ? stage.solid.place : null;
    const plane = stage.plane.isMoved ? stage.plane.place : null;
    if (camera || plane) this.store.remember(this.#seen, { camera, plane });
    // The address names no chosen file, so a camera in it would look at another one. It may name a job already that is
    // not known yet, and a job may be known that is not seen yet.
    const { job } = this.store;
    if (job && job.id === this.place.job && modelOfJob(job) === this.#seen) this.store.go({ camera, plane });
  }

  #take({ source, set, texture }: Facts, loaded: Loaded, analysis: Analysis): void {
    if (!source.isInput) this.calm();
    if (!source.isTurning) this.stage?.solid.turn(false);
    this.model?.dispose();
    this.analysis = analysis;
    byId("panes").dataset.shown = source.name;
    performance.mark("first view");
    const { stage } = this;
    if (!stage) return this.changed();
    this.model = new Model(loaded, analysis, { set, aspect: texture.width / texture.height }, stage.uniforms);
    this.apply();
    this.#look(stage, source);
    this.#lookAtUvs(stage);
    if (this.#relaxing) stage.plane.frame([0, 0, 1, 1]);
    this.changed();
  }

  /** Analysis of the file beside, if there is one. */
  get analysisBeside(): Analysis | null {
    return this.#beside?.model.analysis ?? null;
  }

  /** Index of the atlas that the plane shows. */
  get atlas(): number {
    const found = this.analysis?.atlases.findIndex(({ name }) => name === this.place.atlas) ?? -1;
    return Math.max(found, 0);
  }

  /** Fits everything into the views. */
  frame(from?: Source["from"]): void {
    this.stage?.solid.frame(from ?? (this.model?.isFlat ? [0, 0, 1] : undefined));
    this.#framePlane();
  }

  /** Fits what is selected into the views, or everything without a selection. */
  frameSelection(): void {
    const { stage, model, place, atlas } = this;
    const { face, chart, seam } = place;
    if (!stage || !model) return;
    const { chart: charts, group, borders } = model.analysis;
    const ofSeam = new Set(borders.face.filter((_, k) => borders.seam[k] === seam));
    const isMeant = (one: number) => (face !== null ? one === face : chart !== null ? charts[one] === chart && group[one] === atlas : ofSeam.has(one));
    const extent = (face ?? chart ?? seam) === null ? null : model.extent(isMeant);
    if (!extent) return this.frame();
    stage.solid.fit(extent.sphere);
    if (extent.rectangle) stage.plane.fit(extent.rectangle);
  }

  #framePlane(): void {
    const atlas = this.analysis?.atlases[this.atlas];
    if (!atlas || !this.model) return;
    const { aspect } = this.model;
    const pages = pagesOf(atlas.bounds);
    const [u0, v0, u1, v1] = atlas.isMapped ? atlas.bounds : [0, 0, 1, 1];
    this.stage?.plane.frame([Math.min(0, u0) * aspect, Math.min(0, v0), Math.max(pages, u1) * aspect, Math.max(1, v1)]);
  }

  /** Applies the state to the views. */
  apply(): void {
    const { stage, model, place } = this;
    if (!stage) return;
    const panes = byId("panes");
    if ((panes.dataset.alone ?? null) !== place.alone || place.split !== this.#split) {
      if (place.alone) panes.dataset.alone = place.alone;
      else delete panes.dataset.alone;
      panes.style.setProperty("--split", `${place.split}%`);
      this.#split = place.split;
      stage.resize();
    }
    stage.background = color("--stage");
    stage.redraw();
    if (!model) return;
    const { uniforms } = stage;
    const shade = place.shade === "image" && !this.#image ? "checker" : place.shade;
    uniforms.uShade.value = SHADES.indexOf(shade);
    uniforms.uMeasure.value = MEASURES.indexOf(place.measure);
    uniforms.uAtlas.value = this.atlas;
    uniforms.uAspect.value = model.aspect;
    uniforms.uSeams.value = Number(place.seams);
    uniforms.uWire.value = Number(place.wire);
    uniforms.uProblems.value = Number(place.problems);
    uniforms.uOnly.value.set(...(place.only && place.chart !== null ? [place.chart, this.atlas] as const : [-1, -1] as const));
    uniforms.uChecker.value.set(place.cells, place.cells / model.aspect);
    uniforms.uRange.value.set(...this.range());
    if (this.#image) uniforms.uImage.value = this.#image;
    this.pointing.apply();
    const filled = this.facts && this.#filled(stage, this.#gutters, { model, atlas: this.atlas, texture: this.facts.texture }, uniforms);
    const main = contents(stage, model, { place, atlas: this.atlas, sheet: this.#sheet, filled });
    stage.solid.show(main.solid, model.sphere);
    stage.plane.show(this.#relaxing?.meshes ?? main.plane);
    this.#applyBeside(stage);
    stage.redraw();
  }

  /** Fills the texture of an atlas if it is shown, and frees it otherwise. */
  #filled(stage: Stage, gutters: Gutters, shown: { model: Model; atlas: number; texture: Texture }, uniforms: Uniforms): Object3D | null {
    const { place } = this;
    if (place.shade === "padding" && shown.model.analysis.atlases[shown.atlas]?.isMapped) {
      return gutters.show(stage.renderer, { ...shown, padding: place.padding ?? shown.texture.padding, mip: Math.min(place.mip, levelsOf(shown.texture)) }, uniforms);
    }
    gutters.dispose();
    return null;
  }

  /** Applies the state to the file beside. */
  #applyBeside(stage: Stage): void {
    const { place } = this;
    for (const scene of Object.values(stage.beside)) scene.clear();
    if (!this.#beside) return this.#guttersBeside.dispose();
    const { model, uniforms, texture } = this.#beside;
    uniforms.uAspect.value = model.aspect;
    uniforms.uChecker.value.set(place.cells, place.cells / model.aspect);
    const filled = this.#filled(stage, this.#guttersBeside, { model, atlas: 0, texture }, uniforms);
    const { solid, plane } = contents(stage, model, { place, atlas: 0, sheet: this.#sheetBeside, filled });
    stage.beside.solid.add(...solid);
    stage.beside.plane.add(...plane);
  }

  /** Returns the ends of the heat map's scale: shares of stretch, or texels per unit of length. */
  range(): [number, number] {
    const spread = this.analysis?.atlases[this.atlas]?.spreads[MEASURES.indexOf(this.place.measure)];
    return spread ? rangeOf(this.place.measure, spread, this.place.scale) : [0, 1];
  }

  /** What is shown of the file, to be seen elsewhere; null without a view. */
  get shown(): Shown | null {
    const { analysis, facts, model } = this;
    return analysis && facts && model && { analysis, origins: facts.origins, texture: facts.texture, picture: model.picture() ?? this.#image };
  }

  /** Fills faces with the user's picture. */
  async useImage(file: Blob): Promise<void> {
    const image = await imageOf(file);
    this.#image?.dispose();
    this.#image = image;
  }

  get hasImage(): boolean {
    return this.#image !== null;
  }

  /** Moves both cameras to a face. */
  flyTo(face: number): void {
    const place = this.model?.place(face);
    if (!place || !this.stage) return;
    this.stage.solid.flyTo(place.middle, place.normal, place.size);
    if (Number.isFinite(place.u)) this.stage.plane.flyTo(place.u, place.v, place.planeSize);
  }

  /** Returns the position of a face on the page, in a view. */
  project(view: View, face: number): [number, number] | null {
    const place = this.model?.place(face);
    if (!place || !this.stage) return null;
    const point = view === "solid" ? place.middle : place.middle.clone().set(place.u, place.v, 0);
    return this.stage.project(view, point);
  }
}

/** Returns what a model shows in both views. */
function contents(stage: Stage, model: Model, { place, atlas, sheet, filled }: { place: Readonly<Place>; atlas: number; sheet: Sheet; filled: Object3D | null }) {
  const { solid, plane } = model.surface.layers;
  const isOwn = place.shade === "material" && !(place.only && place.chart !== null);
  const shown = model.analysis.atlases[atlas];
  const picture = isOwn ? model.picture() : null;
  const colors = { paper: color("--sheet"), line: color("--sheet-line"), border: color("--sheet-border") };
  return {
    solid: [...(isOwn ? [model.loaded.scene, ...stage.light(), solid.overlay] : [solid.surface]), solid.borders],
    plane: [...sheet.of(shown ? pagesOf(shown.bounds) : 1, model.aspect, colors, picture), ...(filled ? [filled, plane.overlay] : [picture ? plane.overlay : plane.surface]), plane.borders],
  };
}

function stageOn(places: Places): Stage | null {
  try {
    return new Stage(places);
  } catch {
    return null;
  }
}

function boundsOf(scene: Object3D) {
  return new Box3().setFromObject(scene).getBoundingSphere(new Sphere());
}
