// Errors: each has the stable code that the service and the command line give too.

/** Why a mesh could not be worked on. */
export class UnwrapdError extends Error {
  constructor(message, code = 'internal_error', exitCode = 1) {
    super(message);
    this.name = new.target.name;
    this.code = code;
    this.exitCode = exitCode;
  }
}

/** An option is out of its range, of the wrong type, or without effect. */
export class InvalidOptions extends UnwrapdError {}

/** The mesh or the file cannot be used. */
export class InvalidInput extends UnwrapdError {}

/** No valid result was found. */
export class NoValidResult extends UnwrapdError {}

/** The error for a failure that the addon tells. */
export function errorOf({ code, exitCode, message }) {
  const kind = { 2: InvalidOptions, 3: InvalidInput, 4: NoValidResult }[exitCode] ?? UnwrapdError;
  return new kind(message, code, exitCode);
}
