// What most visits do not need: it is fetched when it is first used.

export { unzipSync } from "three/addons/libs/fflate.module.js";
export { BatchView } from "./app/batch";
export { showReport } from "./app/report_page";
export { pullKeys } from "./pull/keys";
export { PullView } from "./pull/pull_view";
export { addDecoders } from "./viewer/decoders";
export { materialsOf } from "./viewer/materials";
