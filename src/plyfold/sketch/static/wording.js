// Words that several parts of the page share.

/** "vertex moved, 12 times" instead of twelve times the same. */
export function counted(words) {
  return [...new Set(words)].map((word) => {
    const times = words.filter((other) => other === word).length;
    return times > 1 ? `${word}, ${times} times` : word;
  }).join("; ");
}
