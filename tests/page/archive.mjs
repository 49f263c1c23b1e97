// ZIP files as tests need them.
import { crc32 } from "node:zlib";

/** Writes numbers of some bytes each, little-endian. */
function numbers(...pairs) {
  return Buffer.concat(pairs.map(([value, size]) => {
    const one = Buffer.alloc(size);
    one.writeUIntLE(value, 0, size);
    return one;
  }));
}

/** An archive of files, which are stored as they are. */
export function archive(files) {
  const [locals, entries] = [[], []];
  let offset = 0;
  for (const { name, content } of files) {
    const facts = numbers([20, 2], [0, 2], [0, 2], [0, 2], [33, 2], [crc32(content), 4], [content.length, 4], [content.length, 4], [name.length, 2], [0, 2]);
    locals.push(Buffer.concat([Buffer.from("PK\x03\x04"), facts, Buffer.from(name), content]));
    entries.push(Buffer.concat([Buffer.from("PK\x01\x02"), numbers([20, 2]), facts, numbers([0, 2], [0, 2], [0, 2], [0, 4], [offset, 4]), Buffer.from(name)]));
    offset += locals.at(-1).length;
  }
  const directory = Buffer.concat(entries);
  const end = numbers([0, 2], [0, 2], [files.length, 2], [files.length, 2], [directory.length, 4], [offset, 4], [0, 2]);
  return Buffer.concat([...locals, directory, Buffer.from("PK\x05\x06"), end]);
}
