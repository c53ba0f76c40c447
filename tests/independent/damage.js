#!/usr/bin/env node
'use strict';
/* node damage.js FILE...   makes damaged versions of certificates of distances (paths, and edits), has checker.js check each in this
   process, and says what came out. Exit code 1 if one was verified, or said to be incomplete, that may not be. Marked ~: a change
   that can leave all claims true (a tube that was not needed, a longer tube, an s without a meaning), and was verified. At the end of each file
   stand rewritings that say something true, too, and have to pass: tubes in extended precision, a run that stopped, an open path.
   node damage.js --variants FILE...   the rewritings alone. */
const fs = require('fs'), crypto = require('crypto'), { check, readProblem, otherConstraints, makeSystem, sketch, sketchSquare, newton, fix, fl, mid } = require('./checker.js');
const WORD = { 0: 'VERIFIED', 1: 'REFUTED', 2: 'NO CERTIFICATE', 3: 'NOT PROVED', 4: 'INCOMPLETE', 5: 'unsupported' };
// a certificate as its parts; records are { tag, b } with the bytes behind the tag
function parse(buf) {
  let o = 18 + 4; const text = () => { const k = buf.readUInt32LE(o); o += 4 + k; return buf.toString('utf8', o - k, o); };
  const program = text(); o += 32; const problem = text(), e = buf.readInt16LE(o); o += 2;
  const P = readProblem(problem); P.e = e; if (P.distOnly) sketch(P); else otherConstraints(P);
  const { n, m, D } = P, recs = [];
  while (o < buf.length) {
    const tag = buf[o], a = ++o;
    if (tag === 1 || tag === 8) o += (tag === 8 ? 22 : 14) * n + 20;
    else if (tag === 2 || tag === 6) o += 8 * m + 4; else if (tag === 7) o += 8 * m + 16; else if (tag === 4) ;
    else if (tag === 5) { const k = buf.readUInt32LE(o); o += 4; for (let j = 0; j < k; j++) { o += 4; text(); } o += 4 + buf.readUInt32LE(o) * (4 * (D + 1) + 1); }
    else if (tag === 3) {
      const E = { kind: buf[o++], texts: [] }; for (let j = 0; j < E.kind; j++) E.texts.push(text());
      o += 8; const k = buf.readUInt32LE(o); o += 4; E.classes = []; for (let j = 0; j < k; j++, o += 4) E.classes.push(buf.readUInt32LE(o));
      return { program, problem, e, recs, end: E, P };
    }
    recs.push({ tag, b: Buffer.from(buf.subarray(a, o)) });
  }
}
function build(c) {
  const text = s => { const b = Buffer.from(s), k = Buffer.alloc(4); k.writeUInt32LE(b.length); return Buffer.concat([k, b]); };
  const u32 = x => { const b = Buffer.alloc(4); b.writeUInt32LE(x); return b; }, e = Buffer.alloc(2); e.writeInt16LE(c.e);
  const cnt = Buffer.alloc(8); cnt.writeBigUInt64LE(BigInt(c.recs.filter(r => r.tag === 1 || r.tag === 8).length));
  return Buffer.concat([Buffer.from('krawl certificate\n'), u32(3), text(c.program), crypto.createHash('sha256').update(c.problem).digest(), text(c.problem), e,
    ...c.recs.flatMap(r => [Buffer.from([r.tag]), r.b]), Buffer.from([3, c.end.kind]), ...c.end.texts.map(text), cnt, u32(c.end.classes.length), ...c.end.classes.map(u32)]);
}
const copy = c => ({ ...c, recs: c.recs.map(r => ({ tag: r.tag, b: Buffer.from(r.b) })), end: { ...c.end, texts: c.end.texts.slice(), classes: c.end.classes.slice() } });
const renumber = v => { const m = new Map(); return v.map(x => { if (!m.has(x)) m.set(x, m.size); return m.get(x); }); };
const at = (c, tag) => c.recs.map((r, i) => r.tag === tag ? i : -1).filter(i => i >= 0);
const f64 = (b, i, f) => b.writeDoubleLE(f(b.readDoubleLE(i)), i), f32 = (b, i, f) => b.writeFloatLE(f(b.readFloatLE(i)), i);
function damages(c) {
  const L = [], { n, m } = c.P, T = at(c, 1), S = at(c, 2), R = at(c, 6), F = at(c, 7), A = at(c, 5), pick = (v, f) => v[Math.floor(f * (v.length - 1))];
  const add = (name, f) => { const d = copy(c); f(d); L.push([name, d]); };
  for (const f of [0, 0.3, 0.55, 1]) { const i = pick(T, f); add(`tube at record ${i} dropped`, d => d.recs.splice(i, 1)); }
  for (const f of [0, 0.4, 0.8]) { const i = pick(T, f), j = T[T.indexOf(i) + 1]; if (j) add(`tubes ${i} and ${j} swapped`, d => [d.recs[i], d.recs[j]] = [d.recs[j], d.recs[i]]); }
  const mv = [[1e-2, 'by 0.01'], [1e-7, 'by 1e-7'], [1e-11, 'by 1e-11']];
  for (const [x, w] of mv) for (const i of [pick(S, 0.5), pick(R, 1), pick(F, 1)].filter(i => i !== undefined)) add(`figure at record ${i} moved ${w}`, d => f64(d.recs[i].b, 8 * (m >> 1), v => v + x));
  for (const f of [0, 1]) if (S.length) { const i = pick(S, f); add(`solution at record ${i} dropped`, d => { d.end.classes = renumber(d.end.classes.filter((_, k) => k !== S.indexOf(i))); d.recs.splice(i, 1); }); }
  if (S.length) {
    const i = pick(S, 0.5), k = S.indexOf(i), cl = Math.max(...c.end.classes) + 1;
    const ins = (d, b) => { d.recs.splice(i, 0, { tag: 2, b }); d.end.classes = renumber([...d.end.classes.slice(0, k), 5000, ...d.end.classes.slice(k)]); };
    add('an invented solution', d => { const b = Buffer.from(c.recs[i].b); for (let j = 0; j < m; j++) f64(b, 8 * j, v => v + 0.1 * Math.sin(j + 1)); ins(d, b); });
    add('an invented solution with a large radius', d => { const b = Buffer.from(c.recs[i].b); for (let j = 0; j < m; j++) f64(b, 8 * j, v => v + 0.1 * Math.sin(j + 1)); f32(b, 8 * m, () => 0.05); ins(d, b); });
    add('the mirror image of a solution (a zero, but is it met?)', d => {          // last axis reversed
      const b = Buffer.from(c.recs[i].b); c.P.index.forEach(ix => { const j = ix[c.P.D - 1]; if (j >= 0) f64(b, 8 * j, v => -v); });
      d.recs.splice(i, 0, { tag: 2, b }); d.end.classes = renumber([...d.end.classes.slice(0, k), c.end.classes[k], ...d.end.classes.slice(k)]);
    });
    add('a solution listed twice', d => { d.recs.splice(i, 0, { tag: 2, b: Buffer.from(c.recs[i].b) }); d.end.classes.splice(k, 0, c.end.classes[k]); });
    if (c.end.classes.length > 1) add('two solutions claimed to be congruent', d => { d.end.classes[1] = 0; d.end.classes = renumber(d.end.classes); });
    add('a solution listed too late', d => { const [r] = d.recs.splice(S[0], 1); d.recs.splice(T[T.length - 1], 0, r); const [x] = d.end.classes.splice(0, 1); d.end.classes.push(x); d.end.classes = renumber(d.end.classes); });
  }
  const num = (re, f, all) => d => { let k = 0; d.problem = d.problem.replace(re, (g, a, b, z) => k++ === 1 ? a + f(b) + z : g); };
  const dist = /(\["\S+", "\S+", )([0-9.]+)(\])/g;
  add('a target length changed (x 1.01)', num(dist, v => (v * 1.01).toFixed(6)));
  add('a target length changed (+ 1e-9)', num(dist, v => (+v + 1e-9).toFixed(9)));
  add('a point of the sketch moved by 0.5', num(/(\n\S+ = \[)(-?[0-9.]+)(,[^\n]*)/g, v => (+v + 0.5).toFixed(4)));
  if (S.length) add('bend_coefficient changed', d => d.problem = d.problem.replace(/(bend_coefficient = )(\S+)/, (g, a, b) => a + (+b * 1.5).toFixed(4)));
  add('another unit', d => d.e += 1);
  for (const f of [0.2, 0.9]) {
    const i = pick(T, f), e = 14 * n;
    add(`tube ${i}: normal reversed`, d => { for (let j = 0; j < n; j++) f32(d.recs[i].b, 8 * n + 4 * j, v => -v); });
    add(`tube ${i}: centre moved by 100 r`, d => f64(d.recs[i].b, 0, v => v + 100 * c.recs[i].b.readFloatLE(e + 8)));
    add(`tube ${i}: s reversed`, d => f64(d.recs[i].b, e + 12, v => -v));
    add(`tube ${i}: h x 20`, d => f64(d.recs[i].b, e, v => 20 * v));
    add(`tube ${i}: r = 1000`, d => f32(d.recs[i].b, e + 8, () => 1000));
  }
  add('last tube repeated from the first third only', d => { const k = T[Math.floor(T.length / 3)]; d.recs = d.recs.slice(0, k + 1); d.end.classes = d.end.classes.slice(0, at(d, 2).length); });
  add('end: stopped', d => { d.end.kind = 1; d.end.texts = ['damage']; });
  add('end: open', d => { d.end.kind = 2; d.end.texts = ['a', 'b']; });
  if (S.length) add('a turn before the last tube, open', d => { d.recs.splice(T[T.length - 1], 0, { tag: 4, b: Buffer.alloc(0) }); d.end.kind = 2; d.end.texts = ['a', 'b']; });
  for (const i of A) if (c.recs[i].b.readUInt32LE(0)) {
    add('edit: another new length', d => { const b = d.recs[i].b, k = b.readUInt32LE(8); b.write(String(+b.toString('utf8', 12, 12 + k) + 1), 12); });
    add('edit: another dimension', d => d.recs[i].b.writeUInt32LE(3, 4));
    add('edit: leads nothing', d => { const b = d.recs[i].b, k = b.readUInt32LE(8); d.recs[i].b = Buffer.concat([Buffer.alloc(4), b.subarray(12 + k)]); });
  }
  for (const i of A) add(`arc at record ${i}: a sign reversed`, d => { const b = d.recs[i].b; b[b.length - 1] ^= 1; });
  if (A.length) add('first arc dropped', d => d.recs.splice(0, A[1]));
  for (const i of F) {
    add('fold: another t (1e-9)', d => f64(d.recs[i].b, 8 * m + 4, v => v + 1e-9));
    add('fold claimed to be an end', d => { d.recs[i] = { tag: 6, b: d.recs[i].b.subarray(0, 8 * m + 4) }; });
    add('the last tube before the fold dropped', d => d.recs.splice(i - 1, 1));
  }
  if (R.length) { const i = R[R.length - 1]; if (i === c.recs.length - 1) add('end claimed to be a fold', d => { const x = Buffer.alloc(12); x.writeDoubleLE(1, 0); x.writeFloatLE(1e-3, 8); d.recs[i] = { tag: 7, b: Buffer.concat([d.recs[i].b, x]) }; }); }
  return L;
}
function bytes(buf) {                                  // damages of the file itself
  const cut = k => buf.subarray(0, k), flip = (k, x) => { const b = Buffer.from(buf); b[k] ^= x; return b; };
  return [['truncated by a byte', cut(buf.length - 1)], ['truncated in the middle', cut(buf.length >> 1)], ['a byte more', Buffer.concat([buf, Buffer.from([0])])],
    ['a bit of the hash', flip(22 + 4 + buf.readUInt32LE(22) + 5, 1)], ['another version', flip(18, 1)], ['a bit of the last byte', flip(buf.length - 1, 64)]];
}
const A5 = c => at(c, 5).length > 0;
// sigma in tube j (about) of the point where the path leaves tube i
function entryOf(c, i, j) {
  const { P } = c, S = makeSystem(P, P.dist.map(d => sketchSquare(P, d)), P.dist.map(d => d.sq), true), n = P.n;
  const tube = b => { const v = [...Array(n).keys()], cc = v.map(k => b.readFloatLE(8 * n + 4 * k)); return { z0: v.map(k => fix(b.readDoubleLE(8 * k))), c: cc, cf: cc.map(fix), u: Array(n).fill(1), r: 1e-6, s: b.readDoubleLE(14 * n + 12) }; };
  const A = tube(c.recs[i].b), B = tube(c.recs[j].b), x = A.z0.slice();
  for (let k = 1; k <= 8; k++) newton(S, A, x, A.s * k / 8);
  return B.c.reduce((s, v, k) => s + v * mid(fl(x[k] - B.z0[k])), 0);
}
// true rewritings: [name, certificate, code that is expected]
function variants(c) {
  const L = [], n = c.P.n, T = at(c, 1);
  const d = copy(c);
  for (const i of T) {                                 // records 8: z0 split in two
    const b = d.recs[i].b, lo = Buffer.alloc(8 * n);
    for (let j = 0; j < n; j++) { const v = b.readDoubleLE(8 * j), h = Math.fround(v); b.writeDoubleLE(h, 8 * j); lo.writeDoubleLE(v - h, 8 * j); }
    d.recs[i] = { tag: 8, b: Buffer.concat([b.subarray(0, 8 * n), lo, b.subarray(8 * n)]) };
  }
  L.push(['all tubes as records 8', d, 0]);
  const s = copy(c); let k = T[Math.floor(T.length * 0.6)]; while (c.recs[k + 1] && c.recs[k + 1].tag === 2) k++;
  s.recs = s.recs.slice(0, k + 1); s.end = { kind: 1, texts: ['cut'], classes: c.end.classes.slice(0, at(s, 2).length) };
  L.push(['stopped on the way', s, 4]);
  if (!A5(c) && T.length > 3) {                        // the second half of the loop, tubes reversed in reverse order, is a way back
    const w = copy(c), p = Math.floor(T.length / 2); let end = T[p] + 1; while (c.recs[end].tag === 2) end++;
    w.recs = c.recs.slice(0, end); const sols = at(c, 2).slice(at(w, 2).length);
    w.recs.push({ tag: 4, b: Buffer.alloc(0) });
    for (let q = T.length - 1; q > p; q--) {
      const b = Buffer.from(c.recs[T[q]].b); for (let j = 0; j < n; j++) f32(b, 8 * n + 4 * j, v => -v);
      f64(b, 14 * n + 12, () => -entryOf(c, T[q - 1], T[q]));      // leaves where it was entered
      w.recs.push({ tag: 1, b }); if (q === T.length - 1) for (const r of sols) w.recs.push({ tag: 2, b: Buffer.from(c.recs[r].b) });
    }
    w.end = { kind: 2, texts: ['one', 'other'], classes: c.end.classes.slice() };
    L.push(['the second half as a way back, open', w, 0]);
  }
  return L;
}
let bad = 0;
const only = process.argv.includes('--variants');
for (const file of process.argv.slice(2).filter(f => !f.startsWith('--'))) {
  const buf = fs.readFileSync(file), c = parse(buf); console.log(`== ${file}`);
  if (!build(c).equals(buf)) throw new Error('rebuilding does not give the same file');
  const run = (name, b, want) => {
    const may = (/h x 20|s reversed/.test(name) && A5(c)) || /^tube at record .* dropped/.test(name);     // h of a long thin tube, s without meaning, redundant tubes
    const t = Date.now(), v = check(b), ok = want === undefined ? v.code > 0 && v.code < 4 && !/an error of this checker/.test(v.text) : v.code === want; if (!ok && !may) bad++;
    console.log(`${ok ? '  ' : may ? '~ ' : '!!'} ${name.padEnd(56)} ${WORD[v.code]}: ${v.text.slice(0, 150)}   [${((Date.now() - t) / 1000).toFixed(1)} s]`);
  };
  if (!only) { run('the original', buf, 0); for (const [name, d] of damages(c)) run(name, build(d), name === 'end: stopped' ? 4 : undefined); for (const [name, b] of bytes(buf)) run(name, b); }
  for (const [name, d, want] of variants(c)) run('variant: ' + name, build(d), want);
}
console.log(bad ? `${bad} UNEXPECTED` : 'all as expected'); process.exitCode = bad ? 1 : 0;
