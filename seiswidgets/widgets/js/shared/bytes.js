// Numbers from the bytes of a message.

/**
 * Copy the bytes, since they may start at an offset that the number type does not allow.
 *
 * @template {Uint8Array | Float64Array | Float32Array | Uint32Array | Uint16Array | Int16Array} Numbers
 * @param {DataView} bytes
 * @param {new (buffer: ArrayBufferLike) => Numbers} NumberType
 */
export function toNumbers(bytes, NumberType) {
  return new NumberType(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}
