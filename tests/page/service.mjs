// The service of a scenario, which the test kills and starts again.

/** Asks the test for something by a line, and waits until it is done. */
function ask(word) {
  return new Promise((done) => {
    process.stdin.once("data", () => {
      process.stdin.pause();
      // The scenario ends although the test could say more.
      process.stdin.unref();
      done();
    });
    process.stdin.ref();
    process.stdin.resume();
    console.log(word);
  });
}

export const kill = () => ask("kill");
export const restart = () => ask("restart");
