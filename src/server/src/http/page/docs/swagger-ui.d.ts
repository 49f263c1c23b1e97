// Types of the used part of a bundle without types.
declare module "swagger-ui-dist/swagger-ui-es-bundle" {
  interface Settings {
    spec: object; domNode: HTMLElement; deepLinking: boolean; displayOperationId: boolean;
    defaultModelsExpandDepth: number; filter: boolean; validatorUrl: null;
  }
  export default function SwaggerUI(settings: Settings): unknown;
}
