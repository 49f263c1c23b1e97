// Shows the OpenAPI document of this service in Swagger UI, and the codes of its problems below.
import SwaggerUI from "swagger-ui-dist/swagger-ui-es-bundle";
import { byId, element } from "../app/dom";

interface Code { code: string; status: number; title: string }

// Swagger UI follows the theme of the system only on its own pages.
const dark = matchMedia("(prefers-color-scheme: dark)");
const follow = () => document.documentElement.classList.toggle("dark-mode", dark.matches);
dark.addEventListener("change", follow);
follow();

const api = await (await fetch("openapi.json")).json();

const row = ({ code, status, title }: Code) => {
  const cells = [element("code", { textContent: code }), String(status), title];
  return element("tr", { id: code }, ...cells.map((cell) => element("td", {}, cell)));
};
byId("codes").append(...(api["x-problems"] as Code[]).map(row));

const named = document.getElementById(location.hash.slice(1));
if (named) {
  // The document above grows while it loads, so keep the row of the code in view.
  const watch = new ResizeObserver(() => {
    named.scrollIntoView();
    if (document.querySelector(".opblock")) watch.disconnect();
  });
  watch.observe(byId("api"));
}
SwaggerUI({
  // Paths begin at this page, which may lie below the path of a proxy.
  spec: { ...api, servers: [{ url: new URL(".", location.href).pathname.replace(/\/$/, "") || "/" }] },
  domNode: byId("api"),
  // A fragment that names a row of the table is no deep link of Swagger UI.
  deepLinking: !named,
  displayOperationId: true,
  defaultModelsExpandDepth: 0,
  filter: true,
  validatorUrl: null,
});
