#!/usr/bin/env node
'use strict';
/* A checker of krawl certificates (format version 3) in JavaScript, written from docs/how/certificates.md alone, without a look at
   krawl's own, and corrected where that text had been read otherwise than it was meant.

   node checker.js FILE.krawl [-v]     exit code: 0 VERIFIED, 1 REFUTED, 2 no certificate,
                                       3 NOT PROVED, 4 INCOMPLETE, 5 unsupported: not known to this checker

   What it claims. VERIFIED: every claim that docs/how/certificates.md lists for this file holds for the problem in the
   file: tubes (curve for all |sigma| <= h, regular; phi(0) the only zero within r), chain, solutions
   (one zero per box, all points with t = 1 listed, each met, boxes disjoint), classes; of edits the
   tubes, links, t rising, ends and signs. INCOMPLETE: the same for a run that stopped. REFUTED is only
   said where the contrary is proved; everything else is NOT PROVED. Supported is all that docs/how/certificates.md specifies: paths and
   edits, with all objects and constraints of its section *Other constraints*, with and without a reference. Not supported: other objects
   and constraints, and TOML that no run writes.

   What it rests on. Numbers of the file and points near the curve are whole multiples of 2^-1100 and
   are held exactly as BigInts; F at such points is evaluated exactly but for a_e(t), which is
   enclosed (its coefficients are roots, enclosed to 2^-1100). Small differences from such points are
   intervals of doubles. After each operation on doubles a bound is moved outwards by |x| 2^-52 +
   2^-1000 (see up), or a sum of products of doubles gets a bound on all that it rounded away (see
   Ysum). NaN and infinity make every test false, as all tests are written "proved if a < b".

   Method. [-h, h] is cut into pieces. On a piece with middle sigma_m and half width delta, a polynomial
   p(s), |s| <= 1, of degree K is made in floats; G_s(z) = (F(z), c.(z - z0) - sigma_m - delta s). With Y near the
   inverse of [J; c] at the middle, |Y G_s(p(s))| <= eta and |I - Y [J;c]| <= N at all z with |z - p(s)| <= rho:
   if eta + N rho < rho (each coordinate), z -> z - Y G_s(z) is a contraction of the box into itself, so
   there is one zero phi in it for each s, and [J; c] is regular in it. With q = |N| in the norm max |w_i|/rho_i
   it is |phi - p| <= |eta|/(1 - q). Neighbouring pieces hold the same curve where phi of one at their
   common sigma is in the box of the other. */

const fs = require('fs'), crypto = require('crypto');
class Verdict extends Error { constructor(code, text) { super(text); this.code = code; } }
const refuse = t => { throw new Verdict(2, t); };
const refute = t => { throw new Verdict(1, t); };
const notProved = t => { throw new Verdict(3, t); };
const unsupported = t => { throw new Verdict(5, t); };

// ---- Doubles, outwards. ------------------------------------------------------------------------
// For a result v rounded to nearest the exact value is at most the next double above v, which is at most v + e, e =
// |v| 2^-52 + 2^-1000; the rounded v + e is not below that double, as rounding is monotone.
const EPS = 2 ** -52, TINY = 2 ** -1000;
const up = x => x + (Math.abs(x) * EPS + TINY), dn = x => x - (Math.abs(x) * EPS + TINY);
const ZERO = [0, 0];
const iv = x => [x, x], pm = r => [-r, r];
const add = (a, b) => [dn(a[0] + b[0]), up(a[1] + b[1])];
const sub = (a, b) => [dn(a[0] - b[1]), up(a[1] - b[0])];
const mul = (a, b) => {
  const p = a[0] * b[0], q = a[0] * b[1], r = a[1] * b[0], s = a[1] * b[1];
  return [dn(Math.min(p, q, r, s)), up(Math.max(p, q, r, s))];
};
const scale = (x, a) => mul(iv(x), a);
const mag = a => Math.max(Math.abs(a[0]), Math.abs(a[1]));
const mid = a => a[0] / 2 + a[1] / 2;
const rad = (a, m) => up(Math.max(up(a[1] - m), up(m - a[0])));     // largest distance of a point of a from m
const inside = (a, r) => a[0] > -r && a[1] < r;

// ---- Whole numbers of 2^-1100. -----------------------------------------------------------------
const FR = 1100n, ONE = 1n << FR;
const view = new DataView(new ArrayBuffer(8));
function fix(x) {                                   // exact: finite doubles are multiples of 2^-1074
  view.setFloat64(0, x);
  const bits = view.getBigUint64(0), ex = (bits >> 52n) & 2047n, f = bits & ((1n << 52n) - 1n);
  if (ex === 2047n) notProved('a number overflows');
  const m = ex ? (f | 1n << 52n) << (ex + FR - 1075n) : f << (FR - 1074n);
  return bits >> 63n ? -m : m;
}
const bitLength = x => (x < 0n ? -x : x).toString(16).length * 4;
function fl(x, fr = 1100) {                          // an interval of doubles that holds x 2^-fr
  if (x === 0n) return ZERO;
  const sh = Math.max(0, bitLength(x) - 64), m = x >> BigInt(sh), e = sh - fr;
  const p = e < -1000 ? 2 ** -1000 : 2 ** e, p2 = e < -1000 ? 2 ** (e + 1000) : 1;
  const lo = dn(dn(Number(m)) * p * p2);             // Number rounds to nearest; shifts round down
  return sh ? [lo, up(up(Number(m + 1n)) * p * p2)] : [lo, up(up(Number(m)) * p * p2)];
}
const flv = a => [fl(a[0])[0], fl(a[1])[1]];         // of an interval of whole numbers
const fadd = (a, b) => [a[0] + b[0], a[1] + b[1]], fsub = (a, b) => [a[0] - b[1], a[1] - b[0]];
const fmul = (x, b) => { const p = x * b[0], q = x * b[1]; return x < 0n ? [q >> FR, -(-p >> FR)] : [p >> FR, -(-q >> FR)]; };   // a number by an interval
function isqrt(n) {
  if (n < 2n) return n;
  let x = 1n << BigInt(Math.ceil(bitLength(n) / 2) + 1);
  for (;;) { const y = (x + n / x) >> 1n; if (y >= x) return x; x = y; }
}
// root of the rational num/den, divided by 2^e, between two neighbouring whole numbers
function rootFix(num, den, e) {
  if (num === 0n) return [0n, 0n];
  const k = 2n * FR - 2n * BigInt(e), r = isqrt((num << k) / den);    // 2 FR > 2 e always
  return r * r * den === num << k ? [r, r] : [r, r + 1n];
}

// ---- The problem's text. -----------------------------------------------------------------------
function decimal(s) {                                // exact: { n, d } with d a power of ten; at most 200 digits, 0 or from 1e-60 to 1e60
  const v = plainDecimal(s); if (!v) return null;
  const x = v.n < 0n ? -v.n : v.n; if (x !== 0n && (x > 10n ** 60n * v.d || x * 10n ** 60n < v.d)) return null;
  return s.replace(/[eE].*/s, '').replace(/\D/g, '').length > 200 ? null : v;
}
// that of an arc: digits may be missing before or behind the point, and white space may be around it
function arcDecimal(s) {
  const g = /^([+-]?)(?:(\d+)\.?(\d*)|\.(\d+))(?:[eE]([+-]?\d+))?$/.exec(s.trim()); if (!g) return null;
  return decimal(`${g[1]}${g[2] || '0'}.${g[3] || g[4] || '0'}${/[1-9]/.test(s.replace(/[eE].*/s, '')) && g[5] ? 'e' + g[5] : ''}`);
}
function plainDecimal(s) {
  const g = /^([+-]?)(\d+)(?:\.(\d+))?(?:[eE]([+-]?\d{1,4}))?$/.exec(s.replace(/(?<=\d)_(?=\d)/g, ''));
  if (!g) return null;
  const f = g[3] || '', e = Number(g[4] || 0) - f.length, n = BigInt(g[1] + '0' + g[2] + f) ;
  return e >= 0 ? { n: n * 10n ** BigInt(e), d: 1n } : { n, d: 10n ** BigInt(-e) };
}
function toml(text) {                                // as much of TOML as certificates use
  let o = 0;
  const bad = why => refuse(`the problem's text: ${why} (byte ${o})`);
  const skip = nl => { for (;;) { const g = (nl ? /^(?:[ \t\r\n]+|#[^\n]*)/ : /^(?:[ \t]+|#[^\n]*)/).exec(text.slice(o, o + 5000)); if (!g) return; o += g[0].length; } };
  const str = () => {
    const three = text.slice(o, o + 3);
    if (three === "\'\'\'" || three === '"""') {
      let e = o + 3; while (e < text.length && !text.startsWith(three, e)) e += three[0] === '"' && text[e] === '\\' ? 2 : 1;
      while (text[e + 3] === three[0]) e++;
      if (e >= text.length) bad('a string');
      let v = text.slice(o + 3, e).replace(/^\r?\n/, ''); o = e + 3;
      if (three[0] === '"') { v = v.replace(/\\[ \t]*\r?\n\s*/g, '').replace(/[\n\r\t]/g, c => JSON.stringify(c).slice(1, -1)).replace(/(\\.)|"/gs, (g, a) => a || '\\"'); try { v = JSON.parse(`"${v.replace(/\\U([0-9a-fA-F]{8})/g, (_, h) => String.fromCodePoint(parseInt(h, 16)))}"`); } catch { bad('a string'); } }
      return v;
    }
    if (text[o] === "'") { const e = text.indexOf("'", o + 1); if (e < 0) bad('a string'); const s = text.slice(o + 1, e); o = e + 1; return s; }
    const g = /^"(?:[^"\\\n]|\\[^\n])*"/.exec(text.slice(o)); if (!g) bad('a string');
    o += g[0].length;
    try { return JSON.parse(g[0].replace(/\\U([0-9a-fA-F]{8})/g, (_, h) => String.fromCodePoint(parseInt(h, 16)))); } catch { bad('a string'); }
  };
  const key = () => {
    if (text[o] === '"' || text[o] === "'") return str();
    const g = /^[A-Za-z0-9_-]+/.exec(text.slice(o, o + 5000)); if (!g) bad('a key'); o += g[0].length; return g[0];
  };
  const value = () => {
    if (text[o] === '"' || text[o] === "'") return str();
    if (text[o] === '{') {
      const t = new Map(); o++; skip();
      while (text[o] !== '}') {
        const k = key(); skip(); if (text[o] !== '=' || t.has(k)) bad('a key'); o++; skip(); t.set(k, value()); skip();
        if (text[o] === ',') { o++; skip(); } else if (text[o] !== '}') bad('an inline table');
      }
      o++; return t;
    }
    if (text[o] === '[') {
      const a = []; o++;
      for (;;) {
        skip(true); if (text[o] === ']') { o++; return a; }
        a.push(value()); skip(true);
        if (text[o] === ',') o++; else if (text[o] !== ']') bad('a list');
      }
    }
    const g = /^[+\-0-9.eE_]+/.exec(text.slice(o, o + 5000)), v = g && decimal(g[0]); if (!v) bad('a value');
    o += g[0].length; return v;
  };
  const root = new Map(); let table = root;
  for (;;) {
    skip(true); if (o >= text.length) return root;
    if (text[o] === '[') {
      o++; if (text[o] === '[') unsupported('arrays of tables in the problem');
      const k = key(); if (text[o] !== ']' || root.has(k)) bad('a table'); o++; root.set(k, table = new Map());
    } else {
      const k = key(); skip(); if (text[o] !== '=' || table.has(k)) bad('a key'); o++; skip(); table.set(k, value());
    }
    skip(); if (o < text.length && text[o] !== '\n' && text[o] !== '\r') bad('the end of a line');
  }
}
const MORE = ['along', 'ratios', 'differences', 'fixed', 'coincident', 'horizontal', 'vertical', 'on',
  'midpoint', 'collinear', 'tangent', 'equal', 'equal_distances', 'equal_angles', 'symmetric'];
const PLACES = ['x', 'y', 'z', 'dx', 'dy', 'dz'], NUMBERS = ['distances', 'angles', 'radii', 'diameters', ...PLACES];
const KINDS = [...NUMBERS, 'coplanar', 'parallel', 'perpendicular'];     // dimensions are numbered in this order
const isNum = v => v && typeof v.n === 'bigint', isText = v => typeof v === 'string';
function readProblem(text) {
  const root = toml(text);
  const need = (t, k) => t.has(k) ? t.get(k) : refuse(`the problem has no ${k}`);
  for (const k of root.keys()) {
    if (['arcs', 'bodies', 'published'].includes(k)) unsupported(k);
    if (!['name', 'dimension', 'source', 'points', 'lines', 'planes', 'circles', 'spheres', 'constraints', 'homotopy'].includes(k)) refuse(`unknown key ${k}`);
  }
  const dim = need(root, 'dimension');
  if (!isNum(dim) || dim.d !== 1n || (dim.n !== 2n && dim.n !== 3n)) refuse('dimension');
  const D = Number(dim.n), P = { D, names: [], pts: [], dist: [], lines: root.get('lines') || new Map(), planes: root.get('planes') || new Map(), rounds: root.get(Number(dim.n) === 2 ? 'circles' : 'spheres') || new Map(), more: [] };
  for (const k of D === 2 ? ['spheres', 'planes'] : ['circles']) if (root.has(k) && !(root.get(k) instanceof Map && !root.get(k).size)) refuse('objects of the other dimension');
  if (!root.has('name')) unsupported('a problem without a name');
  if (!isText(root.get('name')) || (root.has('source') && !isText(root.get('source')))) refuse('name or source');
  for (const k of ['points', 'constraints', 'homotopy']) if (!(need(root, k) instanceof Map)) refuse(k);
  const raw = [];
  for (const [k, v] of root.get('points')) {
    if (!Array.isArray(v) || v.length !== D || !v.every(isNum)) refuse(`point ${k}`);
    P.names.push(k); raw.push(v);
  }
  const tables = [P.lines, P.planes, P.rounds], called = P.names.concat(...tables.map(t => t instanceof Map ? [...t.keys()] : refuse('a table of objects')));
  if (new Set(called).size < called.length || P.names.length > 4000) refuse('names, or points');
  for (const k of [root.get('name'), ...called]) if (!k.trim() || [...k].length > 64 || /[\x00-\x1f\x7f-\x9f]/.test(k)) refuse(`the name ${k}`);
  P.den = raw.flat().reduce((a, v) => v.d > a ? v.d : a, 1n);          // all coordinates are whole numbers over den
  P.pts = raw.map(v => v.map(x => x.n * (P.den / x.d)));
  const point = s => { const i = isText(s) ? P.names.indexOf(s) : -1; if (i < 0) refuse('a point that is none'); return i; };
  const cons = root.get('constraints');
  for (const k of cons.keys()) if (k !== 'squared_distances' && !KINDS.includes(k)) MORE.includes(k) ? unsupported(k) : refuse(`unknown constraint ${k}`);
  for (const k of ['distances', 'squared_distances']) for (const c of cons.get(k) || []) {
    if (!Array.isArray(c)) refuse(k);
    if (k === 'distances' && !(c.length === 3 && P.names.includes(c[0]) && P.names.includes(c[1]))) continue;
    if (c.length !== 3) refuse(k);
    const [i, j] = [point(c[0]), point(c[1])];
    if (i === j || !isNum(c[2]) || c[2].n <= 0n) refuse('a distance');
    if (P.dist.some(d => (d.i === i && d.j === j) || (d.i === j && d.j === i))) refuse('two distances of one pair');
    if (P.pts[i].every((x, a) => x === P.pts[j][a])) refuse('a distance of points that coincide in the sketch');
    const sq = k !== 'distances';
    P.dist.push({ i, j, squared: sq, sq: sq ? [c[2].n, c[2].d] : [c[2].n ** 2n, c[2].d ** 2n] });   // the square of the target
  }
  for (const k of KINDS) for (const c of cons.get(k) || []) {
    if (!Array.isArray(c)) refuse(k);
    if (k === 'distances' && c.length === 3 && P.names.includes(c[0]) && P.names.includes(c[1])) continue;
    if (c.includes('x-axis') || c.includes('y-axis') || c.includes('z-axis')) unsupported('axes');
    if (NUMBERS.includes(k) !== isNum(c[c.length - 1])) refuse(k);
    const list = c.filter(isText), same = JSON.stringify([k, list]); if (list.length !== c.length - (NUMBERS.includes(k) ? 1 : 0)) refuse(k);
    if (P.more.some(o => o[2] === same)) refuse('a constraint twice');
    P.more.push([k, c, same]);
  }
  P.distOnly = !P.more.length && tables.every(t => !t.size);
  P.free = P.more.some(([k]) => PLACES.includes(k));         // no reference: the axes are those of the text
  const hom = root.get('homotopy');
  for (const k of hom.keys()) if (!['detour', 'reference', 'bend', 'bend_coefficient'].includes(k)) refuse(`unknown key ${k}`);
  const there = k => hom.has(k) ? hom.get(k) : unsupported(`a problem without ${k}`);
  const ref = P.free ? [] : there('reference'), c = there('bend_coefficient');
  if (P.free && hom.has('reference')) refuse('a reference where constraints say where the figure is');
  if (!Array.isArray(ref) || (!P.free && ref.length !== D) || !isNum(c)) refuse('reference or bend_coefficient');
  P.ref = ref.map(point); if (!P.free && new Set(P.ref).size !== D) refuse('reference');
  P.bend = null; P.c = c;
  if (P.dist.length || hom.has('bend')) {
    const bend = there('bend'); if (!Array.isArray(bend) || bend.length !== 2) refuse('bend');
    const [b0, b1] = bend.map(point), hit = P.dist.filter(d => (d.i === b0 && d.j === b1) || (d.i === b1 && d.j === b0));
    if (hit.length !== 1) refuse('bend names no distance');
    P.bend = hit[0];
  }
  // the unknowns: index[point][axis], -1 for coordinates that are 0
  let m = 0;
  P.index = P.names.map((_, p) => { const r = P.ref.indexOf(p); return Array.from({ length: D }, (_, a) => r < 0 || a < r ? m++ : -1); });
  P.detour = hom.get('detour') || { n: 0n, d: 1n }; if (!isNum(P.detour)) refuse('detour');
  P.mX = P.m = m; P.n = m + 1;
  if (m > 6000 || (P.distOnly && m < 1) || (P.distOnly && m !== P.dist.length)) refuse(`${m} unknowns, ${P.dist.length} equations`);
  return P;
}
const idot = (a, b) => a.reduce((s, x, k) => s + x * b[k], 0n);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
// The sketch as the reference sees it, in units of 2^e, enclosed: a position (see below) with t = 0.
function sketch(P) {
  const o = P.free ? Array(P.D).fill(0n) : P.pts[P.ref[0]], rel = P.pts.map(p => p.map((x, k) => x - o[k])), d = rel[P.ref[1]];
  let axes;                                          // vectors along the axes, not of unit length
  if (P.free) axes = o.map((_, k) => o.map((_, j) => j === k ? 1n : 0n));
  else if (P.D === 2) axes = [d, [-d[1], d[0]]];
  else { const N = cross(d, rel[P.ref[2]]); axes = [d, cross(N, d), N]; }
  if (axes.some(a => idot(a, a) === 0n)) refuse('reference points coincide or are in line');
  const x = Array(P.n).fill(0n), off = Array(P.n).fill(ZERO); P.axes = axes; P.rel = rel;
  if (P.more1) P.more1.U.forEach((u, i) => { x[P.mX + i] = u.val[0]; off[P.mX + i] = [0, fl(u.val[1] - u.val[0])[1]]; });
  rel.forEach((v, p) => axes.forEach((a, k) => {
    const i = P.index[p][k], w = idot(v, a); if (i < 0) return;
    const [lo, hi] = rootFix(w * w, P.den ** 2n * idot(a, a), P.e);
    x[i] = w < 0n ? -hi : lo; off[i] = [0, fl(hi - lo)[1]];
  }));
  return { x, off };
}
const sketchSquare = (P, d) => { const v = P.pts[d.i].map((x, k) => x - P.pts[d.j][k]); return [idot(v, v), P.den ** 2n]; };

// ---- Equations. ------------------------------------------------------------------------------------------
// fac: factors x_i - x_j as [i, j] (-1: none); prod: [c, a, b], c times factors a and b; lin: [c, i]; E: coefficients of
// a polynomial in t, intervals of whole numbers. F = sum prod + sum lin - E(t); 2 c is a whole number.
const half = a => [a[0] >> 1n, -(-a[1] >> 1n)];
const fmulI = (a, b) => { const p = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]], lo = p.reduce((x, y) => x < y ? x : y), hi = p.reduce((x, y) => x > y ? x : y); return [lo >> FR, -(-hi >> FR)]; };
const isZero = a => a[0] === 0n && a[1] === 0n;
function pmul(p, q) { const r = Array(p.length + q.length - 1).fill([0n, 0n]); p.forEach((a, i) => q.forEach((b, j) => { r[i + j] = fadd(r[i + j], fmulI(a, b)); })); while (r.length > 1 && isZero(r[r.length - 1])) r.pop(); return r; }
const equation = (fac, prod, lin, E) => ({ fac, prod: prod.map(p => [...p, BigInt(2 * p[0])]), lin: lin.map(l => [...l, BigInt(2 * l[0])]), E });
const enclose = (n, d, e) => { const k = FR - BigInt(e), v = (n << k) / d; return (n << k) % d === 0n ? [v, v] : [v - 1n, v + 1n]; };     // n/d divided by 2^e
// a_e(t) in units of 2^e; from, to: squares of lengths as [num, den]
function lengths(P, from, to, bent) {
  return P.dist.map((d, k) => {
    const a0 = rootFix(...from[k], P.e), a1 = rootFix(...to[k], P.e), c = bent && d === P.bend ? enclose(P.c.n, P.c.d, P.e) : [0n, 0n];
    if (from[k][0] === 0n) refute('a distance is 0 in the sketch: the path is not regular there');
    const same = from[k][0] * to[k][1] === to[k][0] * from[k][1], A = [a0, fadd(same ? [0n, 0n] : fsub(a1, a0), c), [-c[1], -c[0]]];
    while (A.length > 1 && isZero(A[A.length - 1])) A.pop();
    return A;
  });
}
const distanceEquation = (P, d, A) => { const r = [...Array(P.D).keys()]; return equation(r.map(a => [P.index[d.i][a], P.index[d.j][a]]), r.map(a => [0.5, a, a]), [], pmul(A, A).map(half)); };
const makeSystem = (P, from, to, bent) => ({ m: P.m, n: P.n, D: P.D, eqs: P.more1 ? P.more1.eqs : lengths(P, from, to, bent).map((A, k) => distanceEquation(P, P.dist[k], A)) });
// All that is needed of the equations at a point x (whole numbers): F, the factors d, Taylor coefficients E of E at t.
function evaluate(S, x) {
  const T = x[S.m];
  return S.eqs.map(q => {
    let s = 0n; const v = q.fac.map(([i, j]) => (i < 0 ? 0n : x[i]) - (j < 0 ? 0n : x[j])), E = q.E.slice(), g = E.length;
    for (const p of q.prod) s += p[3] * v[p[1]] * v[p[2]];
    for (const l of q.lin) s += l[2] * x[l[1]] << FR;
    for (let k = 0; k < g; k++) for (let j = g - 2; j >= k; j--) E[j] = fadd(E[j], fmul(T, E[j + 1]));
    return { f: [fl(s - (E[0][1] << FR + 1n), 2201)[0], fl(s - (E[0][0] << FR + 1n), 2201)[1]], d: v.map(y => fl(y)), E: E.map(flv) };
  });
}
// bound on sum over j >= from of w(j) |E_j| r^(j - from)
const tail = (E, from, r, w) => { let s = 0; for (let j = E.length - 1; j >= from; j--) s = up(up(s * r) + up(w(j) * mag(E[j]))); return s; };

// ---- Other constraints (paths only): further unknowns, equations, what is positive. ------------------------------
const R = { of: (n, d = 1n) => ({ n, d }), add: (a, b) => ({ n: a.n * b.d + b.n * a.d, d: a.d * b.d }), mul: (a, b) => ({ n: a.n * b.n, d: a.d * b.d }),
  neg: a => ({ n: -a.n, d: a.d }), cmp: (a, b) => a.n * b.d - b.n * a.d, div: (a, b) => b.n < 0n ? { n: -a.n * b.d, d: -a.d * b.n } : { n: a.n * b.d, d: a.d * b.n } };
const rdot = (a, b) => a.reduce((s, x, k) => R.add(s, R.mul(x, b[k])), R.of(0n)), rsub = (a, b) => a.map((x, k) => R.add(x, R.neg(b[k])));
const rcross = (a, b) => [0, 1, 2].map(k => R.add(R.mul(a[(k + 1) % 3], b[(k + 2) % 3]), R.neg(R.mul(a[(k + 2) % 3], b[(k + 1) % 3]))));
// w / root(N), divided by 2^e
function overRoot(w, N, e) { const v = R.div(R.mul(w, w), N), [lo, hi] = rootFix(v.n, v.d, e); return w.n < 0n ? [-hi, -lo] : [lo, hi]; }
function cosDegrees(a) {                               // an enclosure; a rational, in degrees
  const G = FR + 100n, one = 1n << G;
  const atan = k => { let s = 0n, p = one / k, i = 1n; while (p) { s += i % 4n === 1n ? p / i : -(p / i); p /= k * k; i += 2n; } return s; };
  const pi = 4n * (4n * atan(5n) - atan(239n)), x = pi * a.n / (a.d * 180n), x2 = x * x >> G;       // Machin; each of < 2000 steps is off by < 2^-G
  let s = 0n, p = one; for (let k = 0n; p !== 0n && k < 2000n; k += 2n) { s += p; p = -(p * x2 >> G) / ((k + 1n) * (k + 2n)); if (p === -1n) break; }
  return [(s >> 100n) - 2n, (s >> 100n) + 2n];         // errors together are below 2^-(FR + 50), for angles up to 360
}
/* edit: nothing for a path; for an arc { first, from, to, now, then }: squares of the distances as they are and as they are to be, and for each
   other constraint its number likewise. In the first arc of all the sketch stands for what they are. */
function otherConstraints(P, edit = null) {
  const { D, e } = P; P.more1 = null; sketch(P);
  const later = edit && !edit.first, detour = edit ? R.of(0n) : P.detour;
  const rel = P.rel.map(v => v.map(x => R.of(x, P.den))), axes = P.axes.map(v => v.map(x => R.of(x))), r = [...Array(D).keys()];
  const frame = (v, k) => axes.map(a => overRoot(rdot(v, a), rdot(a, a), k * e));       // a vector as the reference sees it
  const A = edit ? lengths(P, edit.from, edit.to, false) : lengths(P, P.dist.map(d => sketchSquare(P, d)), P.dist.map(d => d.sq), true);
  const U = [], eqs = P.dist.map((d, k) => distanceEquation(P, d, A[k])), positive = [], nonzero = [], vecs = new Map();
  // rev: the objects with whose direction (normal) the unknown changes its sign
  const fresh = (k, val, sign, base = false, rev = []) => { U.push({ k, val, sign, base, rev }); return P.mX + U.length - 1; };
  const xor = (...sets) => { const s = new Set(); for (const v of sets) for (const i of v) s.has(i) ? s.delete(i) : s.add(i); return [...s]; };
  // prods: [c, factor, factor], lins: [c, i]
  const put = (prods, lins, E, zero) => {
    const fac = [], at = f => { let i = fac.findIndex(g => g[0] === f[0] && g[1] === f[1]); if (i < 0) i = fac.push(f) - 1; return i; };
    const q = equation(fac, [], [], E), ps = prods.map(([c, f, g]) => [c, at(f), at(g), BigInt(2 * c)]);
    q.prod = ps; q.lin = lins.filter(l => l[1] >= 0).map(l => [...l, BigInt(2 * l[0])]); q.zero = zero || (E.length === 1 && isZero(E[0])); eqs.push(q);
  };
  const one = i => [i, -1], N0 = [0n, 0n], neg = p => p.map(a => [-a[1], -a[0]]);
  const scalar = (v, k) => enclose(v.n, v.d, k * e);
  const pq = (p, q) => {
    const id = `${p}>${q}`; if (vecs.has(id)) return vecs.get(id);
    if (P.pts[p].every((x, a) => x === P.pts[q][a])) refuse('a vector between points that coincide in the sketch');
    const k = P.dist.findIndex(d => (d.i === p && d.j === q) || (d.i === q && d.j === p));
    const v = { id, p, q, f: r.map(a => [P.index[q][a], P.index[p][a]]), v: rsub(rel[q], rel[p]), k: 1, given: k < 0 ? null : A[k], polar: true, rev: [] }; vecs.set(id, v); return v;
  };
  const mirrorAxis = (polar, a) => b => polar ? (a === b ? -1 : 1) : (a === b ? 1 : -1);         // sign of coordinate a if axis b is reversed
  const own = (id, v, k, given) => ({ id, v, k, given, polar: true, rev: [id], f: frame(v, k).map((x, a) => one(fresh(k, x, mirrorAxis(true, a), false, [id]))) });
  const crossOf = (u, v) => {
    const id = `(${u.id} x ${v.id})`; if (vecs.has(id)) return vecs.get(id);
    const w = { id, v: rcross(u.v, v.v), k: u.k + v.k, given: null, polar: u.polar !== v.polar, rev: xor(u.rev, v.rev) };
    w.f = frame(w.v, w.k).map((x, a) => one(fresh(w.k, x, mirrorAxis(w.polar, a), false, w.rev)));
    for (const a of r) { const b = (a + 1) % 3, c = (a + 2) % 3; put([[-1, u.f[b], v.f[c]], [1, u.f[c], v.f[b]]], [[1, w.f[a][0]]], [N0]); }
    vecs.set(id, w); return w;
  };
  const lengthOf = v => {
    if (v.lam !== undefined) return v.lam;
    const s = rdot(v.v, v.v); v.lam = fresh(v.k, rootFix(s.n, s.d, v.k * e), () => 1);
    if (v.given) put([], [[1, v.lam]], v.given); else { put([...v.f.map(f => [1, f, f]), [-1, one(v.lam), one(v.lam)]], [], [N0]); positive.push(v.lam); }
    return v.lam;
  };
  const dot = (u, v) => ({ prods: r.map(a => [1, u.f[a], v.f[a]]), lins: [], val: rdot(u.v, v.v), k: u.k + v.k, rev: xor(u.rev, v.rev) });
  const rhs = p => later ? [N0] : p.val.n !== 0n ? [scalar(p.val, p.k), neg([scalar(p.val, p.k)])[0]] : detour.n === 0n ? [N0] : [N0, scalar(detour, p.k), neg([scalar(detour, p.k)])[0]];
  const vanish = p => put(p.prods, p.lins, rhs(p), true);
  // y: of the constraint's number
  const leads = (start, y) => { if (!later) { const s = start(); return [s, fsub(y(target), s)]; } const a = y(now); return R.cmp(now, target) === 0n ? [a] : [a, fsub(y(target), a)]; };
  const going = (p, vs, y, k) => leads(() => overRoot(p.val, vs.reduce((s, v) => R.mul(s, rdot(v.v, v.v)), R.of(1n)), k * e), y);
  let now = null, target = null;                       // the number of the constraint at hand
  const times = (p, vs, y, k) => {
    const nu = going(p, vs, y, k), given = vs.filter(v => v.given), rest = vs.filter(v => !v.given);
    if (!rest.length) return put(p.prods, p.lins, given.reduce((s, v) => pmul(s, v.given), nu));
    let l = rest.map(lengthOf);
    if (l.length > 1) { const s = rest.map(v => rdot(v.v, v.v)).reduce(R.mul), kk = rest[0].k + rest[1].k, mu = fresh(kk, rootFix(s.n, s.d, kk * e), () => 1); put([[-1, one(l[0]), one(l[1])]], [[1, mu]], [N0]); l = [mu]; }
    const E = given.reduce((s, v) => pmul(s, v.given), nu), n = fresh(k + given.reduce((s, v) => s + v.k, 0), E[0], () => 1, false, p.rev || []);
    put([], [[1, n]], E); put([...p.prods, [-1, one(n), one(l[0])]], p.lins, [N0]);
  };
  const claim = vs => vs.forEach(v => { if (!v.given) nonzero.push(v); });
  const perp = (u, v) => { vanish(dot(u, v)); claim([u, v]); };
  const rats = (v, n) => Array.isArray(v) && v.length === n && v.every(isNum) ? v : refuse('an object');
  const toRel = v => P.free ? v : v.map((x, k) => R.add(x, R.neg(R.of(P.pts[P.ref[0]][k], P.den))));
  const idx = s => { const i = isText(s) ? P.names.indexOf(s) : -1; return i < 0 ? refuse('a point that is none') : i; };
  const different = list => new Set(list).size < list.length ? refuse('a point twice') : list;
  const lineOf = (p, q) => (different([p, q]), { kind: 'line', dir: pq(p, q), base: { f: P.index[p], v: rel[p] }, ends: [p, q] });
  const planeOf = (p, q, s) => (different([p, q, s]), { kind: 'plane', pts: [p, q, s] });
  const objects = new Map();
  for (const [k, v] of P.lines) {
    if (Array.isArray(v)) { if (v.length !== 2) refuse('a line'); const l = lineOf(...v.map(idx)); objects.set(k, { ...l, name: k }); continue; }
    if (!(v instanceof Map) || v.size !== 2) refuse('a line');
    const d = rats(v.get('direction'), D), pt = toRel(rats(v.get('point'), D)), dd = rdot(d, d); if (dd.n === 0n) refuse('a line');
    const b = rsub(pt, d.map(x => R.mul(x, R.div(rdot(pt, d), dd)))), f = frame(b, 1).map((x, a) => fresh(1, x, mirrorAxis(true, a), true));
    const dir = own(`line ${k}`, d, 0, [rootFix(dd.n, dd.d, 0)]);
    put(dir.f.map(g => [1, g, g]), [], [enclose(dd.n, dd.d, 0)]); put(r.map(a => [1, one(f[a]), dir.f[a]]), [], [N0]);
    objects.set(k, { kind: 'line', dir, base: { f, v: b } });
  }
  if (P.planes.size && D === 2) refuse('planes in the plane');
  for (const [k, v] of P.planes) {
    if (Array.isArray(v)) { if (v.length !== 3) refuse('a plane'); objects.set(k, planeOf(...v.map(idx))); continue; }
    if (!(v instanceof Map) || v.size !== 2) refuse('a plane');
    const nn = rats(v.get('normal'), 3), pt = toRel(rats(v.get('point'), 3)), s = rdot(nn, nn); if (s.n === 0n) refuse('a plane');
    const normal = own(`plane ${k}`, nn, 0, [rootFix(s.n, s.d, 0)]), kv = rdot(nn, pt), ki = fresh(1, scalar(kv, 1), () => 1, false, [`plane ${k}`]);
    put(normal.f.map(g => [1, g, g]), [], [enclose(s.n, s.d, 0)]);
    objects.set(k, { kind: 'plane', normal, ki, kv });
  }
  for (const [k, v] of P.rounds) {
    if (!(v instanceof Map) || v.size !== 2 || !isNum(v.get('radius')) || v.get('radius').n <= 0n) refuse('a circle or sphere');
    idx(v.get('center')); const radius = fresh(1, scalar(v.get('radius'), 1), () => 1, true); positive.push(radius);
    objects.set(k, { kind: 'round', radius, value: v.get('radius') });
  }
  const proper = o => { if (o.pts) { const w = rcross(rsub(rel[o.pts[1]], rel[o.pts[0]]), rsub(rel[o.pts[2]], rel[o.pts[0]])); if (rdot(w, w).n === 0n) refuse('a plane through points of a line'); } return o; };
  const normalOf = o => o.normal || crossOf(pq(o.pts[0], o.pts[1]), pq(o.pts[0], o.pts[2])), vectorOf = o => o.kind === 'line' ? o.dir : normalOf(o);
  const diff = (f, v, b) => ({ f: r.map(a => [f[a], b.f[a]]), v: rsub(v, b.v) });
  const height = (o, x) => {
    const n = normalOf(o);
    if (o.pts) { const w = diff(P.index[x], rel[x], { f: P.index[o.pts[0]], v: rel[o.pts[0]] }); return { prods: r.map(a => [1, n.f[a], w.f[a]]), lins: [], val: rdot(n.v, w.v), k: n.k + 1, rev: n.rev }; }
    return { prods: r.map(a => [1, n.f[a], one(P.index[x][a])]), lins: [[-1, o.ki]], val: R.add(rdot(n.v, rel[x]), R.neg(o.kv)), k: 1, rev: n.rev };
  };
  const items = list => {                              // lines and planes, from the left
    const out = [], taken = []; let i = 0;
    while (i < list.length) {
      if (!isText(list[i])) refuse('an item');
      const b = i; if (objects.has(list[i])) { if (objects.get(list[i]).kind === 'round') refuse('an item'); out.push(proper(objects.get(list[i++]))); taken.push([list[b]]); continue; }
      let j = i; while (j < list.length && isText(list[j]) && P.names.includes(list[j])) j++;
      if (j === i) refuse('a name that is none');
      if (D === 3 && (j - i === 3 || j - i === 6)) { out.push(proper(planeOf(...list.slice(i, i + 3).map(idx)))); i += 3; } else if (j - i >= 2) { out.push(lineOf(...list.slice(i, i + 2).map(idx))); i += 2; } else refuse('an item');
      taken.push(list.slice(b, i));
    }
    if (out.length !== 2) refuse('items');
    if (String(taken[0]) === String(taken[1]) || String(taken[0]) === String(taken[1].slice().reverse())) refuse('an item twice');
    return out;
  };
  // y(number), with the sign of v that the number in the problem has it with: settled once for all arcs
  const minus = y => x => neg([y(x)])[0], signed = (y, v) => v.n === 0n ? refuse('a side that the sketch does not tell') : v.n < 0n ? minus(y) : y;
  const nearer = (y, v, positive) => v.n !== 0n && (v.n < 0n) === positive ? minus(y) : y;
  const atPoint = (a, b, c, s, k) => put(r.map(i => [0.5, [P.index[a][i], P.index[c][i]], [P.index[a][i], P.index[c][i]]]), [],      // 1/2 |a - c|^2 = 1/2 l^2 + 1/2 l^2 - s k
    (() => { const add2 = (p, q) => Array.from({ length: Math.max(p.length, q.length) }, (_, i) => fadd(p[i] || N0, q[i] || N0)); const g = v => pmul(v.given, v.given).map(half); return add2(add2(g(pq(b, a)), g(pq(b, c))), s > 0 ? neg(k) : k); })());
  P.more.forEach(([kind, c], at) => {
    const num = NUMBERS.includes(kind) ? c[c.length - 1] : null, list = num ? c.slice(0, -1) : c, named = num !== null && objects.get(list[0]), before = edit && !edit.first ? edit.now[at] : null;
    now = before; target = edit ? edit.then[at] : num;
    const range = x => { if (kind === 'distances' || kind === 'radii' || kind === 'diameters') return x.n > 0n; return kind !== 'angles' || (x.n > 0n && x.n < 180n * x.d); };
    if (num !== null && !range(num)) refuse(`the number of ${kind}`); if (num !== null && !range(target)) notProved(`the number of ${kind} in an arc is out of its range`);
    if (kind === 'radii' || kind === 'diameters') {
      const f = kind === 'radii' ? 1n : 2n; if (list.length !== 1 || !named || named.kind !== 'round') refuse(kind);
      put([], [[Number(f), named.radius]], leads(() => scalar(R.mul(R.of(f), named.value), 1), x => scalar(x, 1))); return;
    }
    if (PLACES.includes(kind)) {
      const a = 'xyz'.indexOf(kind[kind.length - 1]), pts = list.map(idx), two = kind.length === 2; if (a >= D || pts.length !== (two ? 2 : 1)) refuse(kind); different(pts);
      const [p, q] = pts, v = two ? R.add(rel[q][a], R.neg(rel[p][a])) : rel[p][a];
      put([], two ? [[1, P.index[q][a]], [-1, P.index[p][a]]] : [[1, P.index[p][a]]], leads(() => scalar(v, 1), x => scalar(x, 1))); return;
    }
    if (kind === 'distances') {
      const pts = list.map(s => P.names.indexOf(s)), y = v => scalar(v, 1); let x, o;
      if (list.length > 1 && pts.every(i => i >= 0)) { x = pts[0]; o = list.length === 3 ? lineOf(pts[1], pts[2]) : list.length === 4 && D === 3 ? planeOf(...pts.slice(1)) : refuse(kind); }
      else if (list.length === 2 && (pts[0] >= 0) !== (pts[1] >= 0)) { x = Math.max(...pts); o = objects.get(list[pts[0] < 0 ? 0 : 1]) || refuse(kind); }
      else if (pts[0] >= 0 || !named) refuse(kind);
      else {                                           // two lines
        if (list.some(s => (objects.get(s) || {}).kind === 'round')) unsupported('distances from circles and spheres');
        const [a, b] = items(list); if (D === 2 || a.kind !== 'line' || b.kind !== 'line') unsupported('distances of what is parallel because of them');
        const sorted = l => String(l.slice().sort()); if (P.more.some(([k, o]) => k === 'parallel' && sorted(o) === sorted(list))) unsupported('distances of lines in space that are parallel');
        const w = crossOf(a.dir, b.dir), g = diff(b.base.f, b.base.v, a.base), p = { prods: r.map(i => [1, w.f[i], g.f[i]]), lins: [], val: rdot(w.v, g.v), k: w.k + 1, rev: w.rev };
        if (rdot(w.v, w.v).n === 0n) refuse('lines that are parallel in the sketch');
        times(p, [w], signed(y, p.val), 1); return;
      }
      if (o.kind === 'plane') { const p = height(proper(o), x); times(p, [normalOf(o)], signed(y, p.val), 1); return; }
      if (o.kind !== 'line') refuse(kind);
      const u = o.dir, g = diff(P.index[x], rel[x], o.base);
      if (D === 2) {
        const p = { prods: [[1, u.f[0], g.f[1]], [-1, u.f[1], g.f[0]]], lins: [], val: R.add(R.mul(u.v[0], g.v[1]), R.neg(R.mul(u.v[1], g.v[0]))), k: u.k + 1, rev: u.rev };
        times(p, [u], signed(y, p.val), 1);
      } else {
        const l = lengthOf(u), ug = rdot(u.v, g.v), uu = rdot(u.v, u.v), q = fresh(1, overRoot(ug, uu, e), () => 1, false, u.rev);
        put([[1, one(q), one(l)], ...r.map(a => [-1, u.f[a], g.f[a]])], [], [N0]);
        const d2 = R.add(rdot(g.v, g.v), R.neg(R.div(R.mul(ug, ug), uu))); if (d2.n === 0n) refuse('a point on a line in the sketch');
        const dt = leads(() => rootFix(d2.n, d2.d, e), y);
        put([...g.f.map(f => [1, f, f]), [-1, one(q), one(q)]], [], pmul(dt, dt));
      }
    } else if (kind === 'angles') {
      const is90 = x => x.n === 90n * x.d, right = !edit && is90(num), cos = x => is90(x) ? N0 : cosDegrees(x);
      if (list.length === 3 && P.names.includes(list[0])) {
        const [a, b, d] = list.map(idx), u = pq(b, a), v = pq(b, d), p = dot(u, v); if (a === d) refuse('an angle with one leg');
        if (u.given && v.given) atPoint(a, b, d, 1, right ? rhs(p) : pmul(pmul(going(p, [u, v], cos, 0), u.given), v.given));
        else if (right) perp(u, v); else times(p, [u, v], cos, 0);
        return;
      }
      const [a, b] = items(list), u = vectorOf(a), v = vectorOf(b), p = dot(u, v);
      if (a.kind !== b.kind) {
        if (num.n > 90n * num.d) refuse('an angle of a line and a plane'); if (target.n > 90n * target.d) notProved('an angle of a line and a plane in an arc');
        times(p, [u, v], nearer(x => cos(R.add(R.of(90n), R.neg(x))), p.val, true), 0); return;
      }
      const y = nearer(cos, p.val, num.n <= 90n * num.d), common = a.ends && b.ends && u.given && v.given ? a.ends.find(i => b.ends.includes(i)) : undefined;
      if (common !== undefined) {
        const away = o => o.ends[0] === common, far = o => o.ends[away(o) ? 1 : 0];
        if (right) atPoint(far(a), common, far(b), 1, rhs(dot(pq(common, far(a)), pq(common, far(b)))));       // of the legs
        else atPoint(far(a), common, far(b), away(a) === away(b) ? 1 : -1, pmul(pmul(going(p, [u, v], y, 0), u.given), v.given));
      } else if (right) perp(u, v); else times(p, [u, v], y, 0);
    } else if (kind === 'coplanar') {
      const pts = different(list.map(idx)); if (D === 2 || pts.length < 4) refuse(kind);
      if (!P.free && P.ref.every(i => pts.includes(i))) { for (const x of pts) if (!P.ref.includes(x)) { const w = rdot(rel[x], axes[2]), z = overRoot(w, rdot(axes[2], axes[2]), e); put([], [[1, P.index[x][2]]], w.n !== 0n && !later ? [z, neg([z])[0]] : rhs({ val: w, k: 1 }), true); } return; }
      const ab = rsub(rel[pts[1]], rel[pts[0]]), j = pts.findIndex((x, i) => { const w = rcross(ab, rsub(rel[x], rel[pts[0]])); return i > 1 && rdot(w, w).n !== 0n; });
      if (j < 0 && pts.length > 4) refuse('points of a line');
      if (j > 2) [pts[2], pts[j]] = [pts[j], pts[2]];
      const w = crossOf(pq(pts[0], pts[1]), pq(pts[0], pts[2]));
      for (const x of pts.slice(3)) vanish(dot(w, pq(pts[0], x))); if (pts.length > 4) nonzero.push(w);
    } else {
      const [a, b] = items(list), u = vectorOf(a), v = vectorOf(b);
      if ((kind === 'perpendicular') === (a.kind === b.kind)) { perp(u, v); return; }
      claim([u, v]);
      if (D === 2) { vanish({ prods: [[1, u.f[0], v.f[1]], [-1, u.f[1], v.f[0]]], lins: [], val: R.add(R.mul(u.v[0], v.v[1]), R.neg(R.mul(u.v[1], v.v[0]))), k: u.k + v.k, rev: xor(u.rev, v.rev) }); return; }
      const k0 = R.div(rdot(u.v, v.v), rdot(u.v, u.v)), k = fresh(v.k - u.k, scalar(k0, v.k - u.k), () => u.polar === v.polar ? 1 : -1, false, xor(u.rev, v.rev));
      const rho = frame(rsub(v.v, u.v.map(x => R.mul(x, k0))), v.k);
      r.forEach(i => put([[-1, one(k), u.f[i]]], [[1, v.f[i][0]], [-1, v.f[i][1]]], later || isZero(rho[i]) ? [N0] : [rho[i], neg([rho[i]])[0]], true));
    }
  });
  if (P.free) for (const a of r) if (!P.more.some(([k]) => k === 'xyz'[a])) put([], [[1, P.index[0][a]]], [scalar(rel[0][a], 1)]);   // the first point is held
  P.own = [];                                          // lines and planes of their own: unknowns of direction or normal, and the others that change with it
  for (const [k, o] of objects) { const v = o.kind === 'line' ? !o.ends && o.dir : o.normal; if (v) P.own.push({ id: v.id, turn: v.f.map(f => f[0]).concat(o.ki === undefined ? [] : [o.ki]) }); }
  P.m = P.mX + U.length; P.n = P.m + 1; P.more1 = { U, eqs, positive, nonzero };
  if (P.m < 1 || P.m > 6000 || eqs.length !== P.m) refuse(`${P.m} unknowns, ${eqs.length} equations`);
  P.axisOf = []; P.index.forEach(ix => ix.forEach((i, a) => { if (i >= 0) P.axisOf[i] = a; }));
}
// the sign of unknown k if the axes with sg = -1 are reversed
function signOf(P, k, sg, rev = []) {
  if (!P.axisOf) { P.axisOf = []; P.index.forEach(ix => ix.forEach((i, a) => { if (i >= 0) P.axisOf[i] = a; })); }
  return k < P.mX ? sg[P.axisOf[k]] : sg.reduce((s, v, b) => v < 0 ? s * P.more1.U[k - P.mX].sign(b) : s, P.more1.U[k - P.mX].rev.reduce((s, o) => rev.includes(o) ? -s : s, 1));
}
const mirrorHolds = P => !P.more1 || (!P.free && [...Array(P.D).keys()].every(b => { const sg = Array(P.D).fill(1); sg[b] = -1; return changeHolds(P, sg, []); }));
// all equations with t = 1 stay, or change their sign and have 0 on the right
function changeHolds(P, sg, rev) {
    const fs = f => { const s = f.filter(i => i >= 0).map(i => signOf(P, i, sg, rev)); return s.length === 0 ? 2 : s.every(x => x === s[0]) ? s[0] : 0; };
    return P.more1.eqs.every(q => { const t = q.prod.map(([, a, c]) => { const x = fs(q.fac[a]), y = fs(q.fac[c]); return x === 2 || y === 2 ? 2 : x * y; }).concat(q.lin.map(([, i]) => signOf(P, i, sg, rev))).filter(x => x !== 2);
      return t.every(x => x === t[0] && x !== 0) && (t[0] !== -1 || q.zero); });
}
// lengths that are unknowns are positive, and vectors claimed so not zero, for sigma in [a, b]
function checkPositive(P, tube, a, b, name) {
  const work = [[a, b, 0]];
  while (work.length) {
    const [x, y, depth] = work.pop();
    const good = over(tube, [x, y]).every(A => { const s = paramOf(A, [x, y]), val = i => i < 0 ? ZERO : phi(A, i, s, 0n);
      return P.more1.positive.every(i => val(i)[0] > 0) && P.more1.nonzero.every(v => v.f.some(f => { const w = sub(val(f[0]), val(f[1])); return w[0] > 0 || w[1] < 0; })); });
    if (good) continue;
    const z = cut(x, y); if (z === null || depth > 20) notProved(`${name}: a length or vector near sigma = ${x} is not seen not to vanish`);
    work.push([z, y, depth + 1], [x, z, depth + 1]);
  }
}

// ---- Floats (guesses): inverse, Jacobian. -------------------------------------------------------------
function invert(M, n) {
  const A = M.map((r, i) => { const v = new Float64Array(2 * n); v.set(r); v[n + i] = 1; return v; });
  for (let k = 0; k < n; k++) {
    let p = k; for (let i = k + 1; i < n; i++) if (Math.abs(A[i][k]) > Math.abs(A[p][k])) p = i;
    const t = A[k]; A[k] = A[p]; A[p] = t;
    const r = A[k], f = 1 / r[k]; for (let j = k; j < 2 * n; j++) r[j] *= f;
    for (let i = 0; i < n; i++) if (i !== k && A[i][k] !== 0) { const w = A[i], g = w[k]; for (let j = k; j < 2 * n; j++) w[j] -= g * r[j]; }
  }
  return A.map(v => v.slice(n));
}
// Rows of J as lists of [column, middle, radius]; dr: how far factors may be from ev.d, tr: t from its middle
function rows(S, ev, dr, tr) {
  return S.eqs.map((q, e) => {
    const W = ev[e].d.map((d, a) => dr ? add(d, pm(dr[e][a])) : d), row = new Map();
    const put = (i, v) => { if (i >= 0) row.set(i, row.has(i) ? add(row.get(i), v) : v); };
    const neg = v => [-v[1], -v[0]];
    for (const [c, a, b] of q.prod) for (const [x, y] of a === b ? [[a, b]] : [[a, b], [b, a]]) {
      const f = a === b ? 2 * c : c, v = f === 1 ? W[y] : scale(f, W[y]); put(q.fac[x][0], v); put(q.fac[x][1], neg(v));
    }
    for (const [c, i] of q.lin) put(i, iv(c));
    const E = ev[e].E; if (E.length > 1) put(S.m, add(neg(E[1]), pm(tr ? up(tr * tail(E, 2, tr, j => j)) : 0)));
    return [...row].map(([j, v]) => { const x = mid(v); return [j, x, rad(v, x)]; });
  });
}
function dense(S, R, c) { const M = R.map(r => { const v = new Float64Array(S.n); for (const [j, x] of r) v[j] += x; return v; }); M.push(Float64Array.from(c)); return M; }
// |Y f| for a vector of intervals f, rigorous, row by row. A sum of k products in floats is off by at most
// k 2^-53/(1 - k 2^-53) times the sum of their sizes (and underflows, < 2^-1000); (k + 4) 2^-52 is more than that by far.
function Ysum(Y, f) {
  const n = Y.length, fm = f.map(mid), fr = f.map((x, i) => rad(x, fm[i])), g = (n + 4) * EPS;
  return Y.map(y => { let s = 0, a = 0, r = 0; for (let e = 0; e < n; e++) { const v = y[e] * fm[e]; s += v; a += Math.abs(v); r += Math.abs(y[e]) * fr[e]; } return up(up(Math.abs(s) + up(g * a)) + up(r * (1 + g))) + TINY; });
}
const Yabs = (Y, f) => Ysum(Y.map(y => y.map(Math.abs)), f.map(x => [x, x]));     // |Y| f for f >= 0

// ---- Krawczyk's test on a piece. ----------------------------------------------------------------------
const K = 5, KK = 6 * K;
// c.(x - z0) for a position { x, off }
function sigmaOf(tube, pos) {
  let s = 0n, o = ZERO;
  for (let i = 0; i < tube.cf.length; i++) { s += tube.cf[i] * (pos.x[i] - tube.z0[i]); if (pos.off) o = add(o, scale(tube.c[i], pos.off[i])); }
  return add(fl(s, 2200), o);
}
// Newton's method from x (changed in place) on the cross-section sig; gives Y and the evaluation at the end.
function newton(S, tube, x, sig, times = 6) {
  const sf = fix(sig); let last = Infinity;
  for (let k = 0; ; k++) {
    const ev = evaluate(S, x), R = rows(S, ev), Y = invert(dense(S, R, tube.c), S.n);
    let s = -(sf << FR); for (let i = 0; i < S.n; i++) s += tube.cf[i] * (x[i] - tube.z0[i]);
    const gl = fl(s, 2200), f = ev.map(v => v.f); f.push(gl);
    const fm = f.map(mid), w = Y.map(y => { let v = 0; for (let e = 0; e < S.n; e++) v += y[e] * fm[e]; return v; });
    const size = Math.max(...w.map((v, i) => Math.abs(v) / tube.u[i]));
    if (!(size < 1e6)) return null;
    if (k === times || size < 1e-22 * tube.r || (size >= last / 2 && size < 1e-9 * tube.r)) return { ev, Y, f };
    last = size;
    for (let i = 0; i < S.n; i++) x[i] -= fix(w[i]);
  }
}
// A piece: { x, sig, del, d: [null, d1..dK], rho, eps, q, Y, ... }, or null. newt false: x stays where it is.
function test(S, tube, x0, sig, del, rho, newt = true) {
  const { m, n } = S, x = x0.slice(), got = newton(S, tube, x, sig, newt ? 6 : 0);
  if (!got) return null;
  const { ev, Y, f } = got, order = del > 0 ? K : 0, d = [null];
  // Taylor coefficients in floats: J d_k = -(what lower orders give)
  for (let k = 1; k <= order; k++) {
    const rhs = new Float64Array(n);
    if (k === 1) rhs[m] = -del;
    else {
      const th = d.map(v => v ? v[m] : 0), pw = [null, th];
      for (let j = 2; j <= 6; j++) { pw[j] = []; for (let a = 0; a <= k; a++) { let s = 0; for (let b = 1; b < a; b++) s += (th[b] || 0) * (pw[j - 1][a - b] || 0); pw[j].push(s); } }
      S.eqs.forEach((q, e) => {
        let s = 0;
        for (const [c, x, y] of q.prod) for (let b = 1; b < k; b++) s += c * dif(q, x, d[b]) * dif(q, y, d[k - b]);
        for (let j = 2; j < ev[e].E.length; j++) s -= mid(ev[e].E[j]) * pw[j][k];
        rhs[e] = s;
      });
    }
    d.push(Float64Array.from(Y, y => { let v = 0; for (let e = 0; e < n; e++) v -= y[e] * rhs[e]; return v; }));
  }
  const A = { S, tube, x, sig, del, d, Y, ev, rho };
  // coefficients of G_s(p(s)), rigorous: f0, fk[1..order], and hi = sum of the sizes of those above, hik with weights k
  const fk = [f]; for (let k = 1; k <= order; k++) fk.push([]);
  const hi = [], hik = [], th = Array(KK + 1).fill(ZERO), pw = [null, th];
  for (let k = 1; k <= order; k++) th[k] = iv(d[k][m]);
  const deg = Math.max(...S.eqs.map(q => q.E.length)) - 1;
  if (order) for (let j = 2; j <= deg; j++) { pw[j] = Array(KK + 1).fill(ZERO); for (let a = 1; a <= order; a++) for (let b = j - 1; a + b <= KK && b <= (j - 1) * order; b++) pw[j][a + b] = add(pw[j][a + b], mul(th[a], pw[j - 1][b])); }
  A.dr = [];
  S.eqs.forEach((q, e) => {
    let h = 0, hk = 0;
    const Dk = q.fac.map((_, a) => d.map(v => v ? difI(q, a, v) : ev[e].d[a])), dr = Dk.map(v => v.reduce((s, w, k) => k ? up(s + mag(w)) : 0, 0));
    A.dr.push(dr);
    for (let k = 1; order && k <= Math.max(2, q.E.length - 1) * K; k++) {
      let s = ZERO;
      for (const [c, a, b] of q.prod) {
        if (a !== b) for (let j = Math.max(0, k - order); j <= k && j <= order; j++) s = add(s, scale(c, mul(Dk[a][j], Dk[b][k - j])));
        else for (let j = Math.max(0, k - order); 2 * j <= k && j <= order; j++) { const v = mul(Dk[a][j], Dk[a][k - j]); s = add(s, scale(2 * j === k ? c : 2 * c, v)); }
      }
      if (k <= order) for (const [c, i] of q.lin) s = add(s, scale(c, iv(d[k][i])));
      for (let j = 1; j < q.E.length; j++) s = sub(s, mul(ev[e].E[j], pw[j][k]));
      if (k <= order) fk[k].push(s); else { h = up(h + mag(s)); hk = up(hk + up(k * mag(s))); }
    }
    hi.push(h); hik.push(hk);
  });
  hi.push(0); hik.push(0);
  for (let k = 1; k <= order; k++) { let s = k === 1 ? iv(-del) : ZERO; for (let i = 0; i < n; i++) s = add(s, mul(iv(tube.c[i]), iv(d[k][i]))); fk[k].push(s); }
  const Yf = fk.map(v => Ysum(Y, v)), Yhi = order ? Yabs(Y, hi) : hi;
  const eta = Yhi.map((v, i) => Yf.reduce((s, w) => up(s + w[i]), v));
  // N rho: |I - Y J_mid| rho + |Y| (radius of J) rho
  A.tr = d.reduce((s, v) => v ? up(s + Math.abs(v[m])) : s, 0);
  const dr = S.eqs.map((q, e) => A.dr[e].map((v, a) => up(v + wide(q, a, rho))));
  const R = rows(S, ev, dr, up(A.tr + rho[m])), Nr = [];
  const jr = R.map(r => r.reduce((s, v) => up(s + up(v[2] * rho[v[0]])), 0)); jr.push(0);
  const Yj = Yabs(Y, jr), g = (4 * n + 8) * EPS, acc = new Float64Array(n), abs = new Float64Array(n);
  for (let i = 0; i < n; i++) {
    acc.fill(0); abs.fill(0); acc[i] = -1; abs[i] = 1;
    for (let e = 0; e < m; e++) for (const [j, v] of R[e]) { const p = Y[i][e] * v; acc[j] += p; abs[j] += Math.abs(p); }
    let s = 0;
    for (let j = 0; j < n; j++) { const p = Y[i][m] * tube.c[j]; s = up(s + up(rho[j] * up(up(Math.abs(acc[j] + p) + g * (abs[j] + Math.abs(p))) + TINY))); }
    Nr.push(up(s + Yj[i]));
  }
  let q = 0, w = 0;
  for (let i = 0; i < n; i++) {
    if (!(up(eta[i] + Nr[i]) < rho[i])) return A.failed = true, A;
    q = Math.max(q, up(Nr[i] / rho[i])); w = Math.max(w, up(eta[i] / rho[i]));
  }
  if (!(q < (del > 0 ? 0.9 : 1))) return A.failed = true, A;
  A.q = q; A.inv = up(1 / dn(1 - q)); const wn = up(w * A.inv);
  A.eps = rho.map(r => up(r * wn)); A.Yf = Yf; A.hik = hik;
  return A;
}
const dif = (q, a, v) => { const [i, j] = q.fac[a]; return (i < 0 ? 0 : v[i]) - (j < 0 ? 0 : v[j]); };
const difI = (q, a, v) => { const [i, j] = q.fac[a]; return i < 0 ? (j < 0 ? ZERO : iv(-v[j])) : j < 0 ? iv(v[i]) : sub(iv(v[i]), iv(v[j])); };
const wide = (q, a, r) => { const [i, j] = q.fac[a]; return up((i < 0 ? 0 : r[i]) + (j < 0 ? 0 : r[j])); };

// ---- What a piece tells about phi. ------------------------------------------------------------------------
const lo = A => A.sig - A.del, hiS = A => A.sig + A.del;
function paramOf(A, sg) {                             // s for an interval of sigma, clipped to [-1, 1] (phi is asked within only)
  if (!(A.del > 0)) return ZERO;
  const a = sub(sg, iv(A.sig)); return [Math.max(-1, dn(a[0] / A.del)), Math.min(1, up(a[1] / A.del))];
}
function poly(A, i, s, der = 0) {                      // sum over k >= 1 (or derivative) of d_k[i] s^k, Horner
  let v = ZERO;
  for (let k = A.d.length - 1; k >= 1; k--) {
    const f = der === 0 ? 1 : der === 1 ? k : k * (k - 1); if (k < der) break;
    v = add(mul(v, s), scale(f, iv(A.d[k][i])));
  }
  return der === 0 ? mul(v, s) : v;
}
// phi_i(sigma) - base_i, base whole numbers
const phi = (A, i, s, base) => add(add(fl(A.x[i] - base), poly(A, i, s)), pm(A.eps[i]));
// bound on |phi' - p'| in units of s, for all of the piece
function slopeError(A) {
  if (A.derr) return A.derr;
  const { S } = A, res = Array(S.n).fill(0), V = k => A.d.reduce((s, v, j) => j ? up(s + up(j * mag(k(v)))) : 0, 0);
  const extra = S.eqs.map((q, e) => {
    let s = A.hik[e];
    for (const [c, a, b] of q.prod) s = up(s + up(Math.abs(c) * up(up(wide(q, a, A.eps) * V(v => difI(q, b, v))) + up(wide(q, b, A.eps) * V(v => difI(q, a, v))))));
    const E2 = tail(A.ev[e].E, 2, up(A.tr + A.eps[S.m]), j => j * (j - 1));           // |E'(t) - E'(t')| <= max |E''| eps
    return up(s + up(up(E2 * A.eps[S.m]) * V(v => iv(v[S.m]))));
  });
  extra.push(0);
  const y = Yabs(A.Y, extra); let w = 0;
  for (let i = 0; i < S.n; i++) { let s = y[i]; for (let k = 1; k < A.Yf.length; k++) s = up(s + up(k * A.Yf[k][i])); w = Math.max(w, up(s / A.rho[i])); }
  w = up(w * A.inv);
  return A.derr = A.rho.map(r => up(r * w));
}
const slope = (A, i, s) => { const v = add(poly(A, i, s, 1), pm(slopeError(A)[i])); return [dn(v[0] / A.del), up(v[1] / A.del)]; };   // dphi_i/dsigma
// d^2 t/d sigma^2 on s in [s0, s1]: [J; c] phi'' = (-F''[phi', phi'], 0), phi'' near v2
function curvature(A, s) {
  const { S } = A, n = S.n, V = [], v2 = [];
  for (let i = 0; i < n; i++) { V.push(slope(A, i, s)); v2.push(mid(poly(A, i, s, 2)) / (A.del * A.del)); }
  const th = add(poly(A, S.m, s), pm(A.eps[S.m])), X = Array.from({ length: S.m }, (_, i) => add(poly(A, i, s), pm(A.eps[i])));
  const at = (q, a, W) => { const [i, j] = q.fac[a]; return sub(i < 0 ? ZERO : W[i], j < 0 ? ZERO : W[j]); };
  const g = S.eqs.map((q, e) => {
    const E = A.ev[e].E, der = (k, w) => { let v = ZERO; for (let j = E.length - 1; j >= k; j--) v = add(mul(v, th), scale(w(j), E[j])); return v; };
    let r = ZERO;
    for (const [c, a, b] of q.prod) {
      const J = x => add(A.ev[e].d[x], at(q, x, X)), vv = mul(at(q, a, V), at(q, b, V));
      r = add(r, scale(c, add(scale(2, vv), add(mul(J(b), difI(q, a, v2)), mul(J(a), difI(q, b, v2))))));
    }
    for (const [c, i] of q.lin) r = add(r, scale(c, iv(v2[i])));
    return sub(r, add(mul(der(2, j => j * (j - 1)), mul(V[S.m], V[S.m])), scale(v2[S.m], der(1, j => j))));
  });
  let l = ZERO; for (let i = 0; i < n; i++) l = add(l, mul(iv(A.tube.c[i]), iv(v2[i]))); g.push(l);
  const y = Ysum(A.Y, g); let w = 0; for (let i = 0; i < n; i++) w = Math.max(w, up(y[i] / A.rho[i]));
  return add(iv(v2[S.m]), pm(up(A.rho[S.m] * up(w * A.inv))));
}

// ---- Tubes. ----------------------------------------------------------------------------------------------
const rhoOf = (tube, f) => tube.u.map(v => v * tube.r * f);
function near(A, sig) {                                // floats: the point of A's polynomial at sigma, as whole numbers
  const s = A.del > 0 ? (sig - A.sig) / A.del : 0;
  return A.x.map((x, i) => { let v = 0; for (let k = A.d.length - 1; k >= 1; k--) v = (v + A.d[k][i]) * s; return x + fix(v); });
}
const inBox = (A, s, pos) => pos.x.every((x, i) => inside(sub(add(fl(x - A.x[i]), pos.off[i]), poly(A, i, s)), A.rho[i]));
const joined = (A, B, sg) => { const sB = paramOf(B, sg); return inBox(A, paramOf(A, sg), { x: B.x, off: B.x.map((_, i) => add(poly(B, i, sB), pm(B.eps[i]))) }); };
function proveTube(S, tube, name) {
  const z = test(S, tube, tube.z0, 0, 0, rhoOf(tube, 1), false);       // phi(0): the only zero within r
  if (!z) notProved(`${name}: its matrix is singular`);
  if (z.failed) {
    const w = Ysum(z.Y, evaluate(S, tube.z0).map(v => v.f).concat([ZERO]));
    notProved(`${name}: no contraction within r around its point (|Y F|/r is up to ${Math.max(...w.map((v, i) => v / (tube.u[i] * tube.r))).toExponential(2)})`);
  }
  tube.S = S; tube.pieces = []; const seeds = [];
  const first = test(S, tube, tube.z0, 0, tube.h, rhoOf(tube, 0.25)); if (first) seeds.push(first);
  const work = [[tube.h / 2, tube.h, 2], [0, tube.h / 2, 2], [-tube.h / 2, 0, 2], [-tube.h, -tube.h / 2, 2]]; let tries = 0;
  if (first && !first.failed) { tube.pieces.push(first); work.length = 0; }
  while (work.length) {
    const [a, b, depth] = work.pop(), s = (a + b) / 2, del = (b - a) / 2 * (1 + 2 ** -30);
    if (++tries > 400 || depth > 12) notProved(`${name}: the curve could not be followed to its ends`);
    const seed = seeds.reduce((x, y) => !x || Math.abs(y.sig - s) < Math.abs(x.sig - s) ? y : x, null);
    const A = test(S, tube, seed ? near(seed, s) : tube.z0, s, del, rhoOf(tube, depth < 5 ? 0.25 : depth < 7 ? 0.0625 : 2 ** -8));
    if (A && !A.failed) { A.a = a; A.b = b; tube.pieces.push(A); seeds.push(A); }
    else { if (A) seeds.push(A); work.push([s, b, depth + 1], [a, s, depth + 1]); }
  }
  const p = tube.pieces; if (p.length === 1 && p[0] === first) { p[0].a = -tube.h; p[0].b = tube.h; }
  p.sort((x, y) => x.a - y.a);
  for (let k = 0; k + 1 < p.length; k++) if (!joined(p[k], p[k + 1], iv(p[k].b)) && !joined(p[k + 1], p[k], iv(p[k].b))) notProved(`${name}: pieces do not hold the same curve`);
  for (const A of p) if (A.a <= 0 && A.b >= 0) {                         // and this curve is the one through phi(0)
    const s = paramOf(A, ZERO);
    if (!A.x.every((_, i) => inside(phi(A, i, s, tube.z0[i]), z.rho[i]))) notProved(`${name}: phi(0) is not seen to be within r`);
  }
}
const over = (tube, sg) => { const p = tube.pieces.filter(A => !(A.b < sg[0]) && !(A.a > sg[1])); return p.length ? p : notProved('a place outside of a tube'); };
// Is the zero at pos a point phi(sigma) of the tube? Its sigma, or null. (certainly not: 'out')
function locate(tube, pos) {
  const sg = sigmaOf(tube, pos);
  if (sg[0] > tube.h || sg[1] < -tube.h) return 'out';
  if (!(sg[0] >= -tube.h && sg[1] <= tube.h)) return null;
  let out = true, ok = true;
  for (const A of over(tube, sg)) {
    const s = paramOf(A, sg); if (!inBox(A, s, pos)) ok = false;
    if (!pos.x.some((x, i) => { const v = sub(add(fl(x - A.x[i]), pos.off[i]), add(poly(A, i, s), pm(A.eps[i]))); return v[0] > 0 || v[1] < 0; })) out = false;
  }
  return ok ? sg : out ? 'out' : null;
}
// the point phi(sigma) for an exact sigma, closely enclosed
function pointAt(tube, sig) {
  const A = over(tube, iv(sig))[0], B = A && test(tube.S, tube, near(A, sig), sig, 0, A.rho.map(v => v / 4));
  if (!B || B.failed) return null;
  const pos = { x: B.x, off: B.eps.map(pm) };
  return inBox(A, paramOf(A, iv(sig)), pos) ? pos : null;
}
// the tangent of phi on sg, with c.T = 1, times a normal: sign, or 0 for unknown
function along(tube, sg, normal) {
  let sign = null;
  for (const A of over(tube, sg)) {
    const s = paramOf(A, sg); let v = ZERO;
    for (let i = 0; i < normal.length; i++) v = add(v, scale(normal[i], slope(A, i, s)));
    const g = v[0] > 0 ? 1 : v[1] < 0 ? -1 : 0; if (sign !== null && sign !== g) return 0; sign = g;
  }
  return sign || 0;
}
const slopeT = (tube, sg) => { const e = Array(tube.S.n).fill(0); e[tube.S.m] = 1; return along(tube, sg, e); };
const sure = (tube, x) => x > tube.entry[1] && x < tube.exit;             // certainly between entry and exit
const cut = (a, b) => { const x = a / 2 + b / 2; return x > a && x < b ? x : null; };

// ---- Boxes: exactly one zero of F(X, 1). ---------------------------------------------------------------------
function proveBox(S, box, name) {
  const c = Array(S.n).fill(0); c[S.m] = 1;
  const x = box.mid.map(fix); x.push(ONE);
  const T = { c, cf: c.map(fix), z0: x, u: Array(S.n).fill(1), r: box.radius, h: 0 };
  const A = test(S, T, x, 0, 0, Array(S.n).fill(box.radius), false);
  if (!A) notProved(`${name}: its matrix is singular`);
  if (A.failed) {                                      // does an equation exclude a zero in the whole box?
    const f = evaluate(S, x), w = pm(2 * box.radius);  // by so much factors change in it
    f.forEach((v, e) => {
      const q = S.eqs[e]; let g = v.f;
      for (const [c, a, b] of q.prod) g = add(g, scale(c, add(mul(w, w), mul(w, add(pm(mag(v.d[a])), pm(mag(v.d[b])))))));
      for (const [c] of q.lin) g = add(g, scale(c, w));
      if (g[0] > 0 || g[1] < 0) refute(`${name}: there is no zero in its box`);
    });
    const y = Ysum(A.Y, f.map(v => v.f).concat([ZERO]));
    notProved(`${name}: no contraction of its box; |Y F|/radius is up to ${(Math.max(...y) / box.radius).toExponential(2)}`);
  }
  // a larger box around the zero, in which it is alone, if there is one: it is the same zero if it is in that box
  let U = A;
  for (let r = 2 ** -6; r > box.radius; r /= 4) {
    const B = test(S, T, x, 0, 0, Array(S.n).fill(r));
    if (B && !B.failed && x.every((v, i) => inside(add(fl(v - B.x[i]), pm(A.eps[i])), B.rho[i]))) { U = B; break; }
  }
  const off = U.eps.map(pm), px = U.x.slice(); off[S.m] = ZERO; px[S.m] = ONE;       // t = 1 exactly
  box.pos = { x: px, off }; box.alone = { x: U.x, rho: U.rho }; box.x = x;
}
const apart = (a, b) => a.x.some((v, i) => { const d = v - b.x[i], r = fix(a.radius) + fix(b.radius); return (d < 0n ? -d : d) > r && i < a.mid.length; });

// ---- Reading. ------------------------------------------------------------------------------------------------
function read(buf) {
  let o = 0;
  const take = k => { if (o + k > buf.length) refuse('truncated'); o += k; return o - k; };
  const big = x => Number.isFinite(x) && Math.abs(x) <= 2 ** 40 ? x : refuse('a number out of range');
  const u8 = () => buf[take(1)], u16 = () => buf.readUInt16LE(take(2)), u32 = () => buf.readUInt32LE(take(4));
  const f64 = () => big(buf.readDoubleLE(take(8))), f32 = () => big(buf.readFloatLE(take(4)));
  const many = (k, f) => Array.from({ length: k }, f);
  const utf = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true });
  const text = max => { const k = u32(); if (k > max) refuse('a text too long'); const a = take(k); try { return utf.decode(buf.subarray(a, a + k)); } catch { refuse('a text that is not UTF-8'); } };
  const magic = 'krawl certificate\n';
  if (buf.subarray(0, magic.length).toString('latin1') !== magic) refuse('not a krawl certificate'); o = magic.length;
  if (u32() !== 3) refuse('another version of the format');
  text(4096);
  const h = take(32), hash = buf.subarray(h, h + 32), ptext = text(1 << 20);
  if (!crypto.createHash('sha256').update(ptext, 'utf8').digest().equals(hash)) refuse("the hash of the problem's text differs");
  const P = readProblem(ptext), { D } = P;
  P.e = buf.readInt16LE(take(2)); if (Math.abs(P.e) > 220) refuse('e out of range');
  if (!P.distOnly) otherConstraints(P);
  let { m, n } = P;
  const positive = x => x > 0 ? x : refuse('a radius or length that is not positive');
  const box = () => ({ mid: many(m, f64), radius: positive(f32()) });
  const C = { P, ways: [[]], arcs: [], sols: [], tubes: 0, kind: null };
  let last = 'start', arc = null, newest = null;                     // last: start, tube, solution, turn, arc, reached, fold
  for (;;) {
    const tag = u8();
    if (tag === 1 || tag === 8) {
      if (last === 'fold' || last === 'reached') refuse('a tube behind an end');
      if (last === 'start') C.kind = 'path';
      const a = many(n, f64), b = tag === 8 ? many(n, f64) : null, c = many(n, f32);
      const u = many(n, u16); if (u.includes(0)) refuse('a weight of 0');
      const hh = positive(f64()), r = positive(f32()), s = f64(); if (!(Math.abs(s) <= hh)) refuse('s beyond h');
      const tube = { z0: a.map((x, i) => fix(x) + (b ? fix(b[i]) : 0n)), c, cf: c.map(fix), u: u.map(x => x / 65536), h: hh, r, s, behind: C.sols.length, no: ++C.tubes };
      newest = tube;
      (arc ? arc.tubes : C.ways[C.ways.length - 1]).push(tube); last = 'tube';
    } else if (tag === 2) {
      if (C.kind !== 'path' || (last !== 'tube' && last !== 'solution')) refuse('a solution out of place');
      if (C.sols.length >= 4096) refuse('too many solutions');
      C.sols.push(box()); last = 'solution'; newest.behind = C.sols.length;
    } else if (tag === 4) {
      if (C.kind !== 'path' || C.ways.length > 1 || (last !== 'tube' && last !== 'solution')) refuse('a turn out of place');
      C.ways.push([]); last = 'turn';
    } else if (tag === 5 || tag === 9) {
      if ((tag === 5) !== P.distOnly) refuse('an arc of the wrong record');
      if (tag === 9 && !C.arcs.length && last === 'start') { otherConstraints(P, firstArc(P)); m = P.m; n = P.n; }
      if (last !== 'start' && last !== 'reached') refuse('an arc out of place');
      C.kind = 'edits'; arc = { led: new Map(), signs: [], tubes: [], end: null };
      const k = u32();
      if (k > P.dist.length + P.more.length) refuse('too many dimensions');
      for (let j = 0; j < k; j++) {
        const i = u32(), v = arcDecimal(text(512)), other = P.more[i - P.dist.length];
        if (arc.led.has(i) || (i >= P.dist.length && !(other && NUMBERS.includes(other[0])))) refuse('a dimension'); if (!v || (i < P.dist.length && v.n <= 0n)) refuse('a value');
        arc.led.set(i, v);
      }
      const g = u32(); if (g > 1 << 20) refuse('too many signs');
      for (let j = 0; j < g; j++) {
        const p = many(D + 1, u32), s = u8(); if (s > 1 || p.some(i => i >= P.names.length)) refuse('a sign'); arc.signs.push({ p, s: s ? 1 : -1 });
      }
      C.arcs.push(arc); last = 'arc';
    } else if (tag === 6 || tag === 7) {
      if (!arc || last !== 'tube') refuse('an end of an arc out of place');
      arc.end = box(); last = tag === 6 ? 'reached' : 'fold'; arc.end.kind = last;
      if (tag === 7) { arc.end.t = f64(); arc.end.tr = positive(f32()); }
    } else if (tag === 10 || tag === 11) {
      unsupported(`records ${tag}, of equations with heights divided by 1 - t`);
    } else if (tag === 15) {
      unsupported('a record 15, of a motion');
    } else if (tag === 3) {
      C.end = u8(); if (C.end > 2) refuse('an end that is none');
      C.texts = many(C.end, () => text(4096));
      const k = buf.readBigUInt64LE(take(8)), s = u32();
      if (k !== BigInt(C.tubes)) refuse('the number of tubes'); if (s !== C.sols.length) refuse('the number of solutions');
      C.classes = many(s, u32);
      break;
    } else refuse(`a record of unknown kind ${tag}`);
  }
  if (o !== buf.length) refuse('something behind the end record');
  const E = C.end;
  if (C.kind === 'edits') {
    if (E === 2 || ((last === 'tube' || last === 'arc') && E !== 1)) refuse('an end that does not fit');
  } else {
    if (C.ways.length > 1 ? E === 0 : E === 2) refuse('an end that does not fit');
    if (E === 2 && !C.ways[1].length) refuse('no tubes');
  }
  return C;
}

const firstArc = P => ({ first: true, from: P.dist.map(d => sketchSquare(P, d)), to: P.dist.map(d => d.sq), then: P.more.map(([, c]) => c[c.length - 1]) });

// ---- Paths. --------------------------------------------------------------------------------------------------
function link(prev, tube, name) {                     // both proved; sets tube.entry, an interval
  const P = pointAt(prev, prev.s); if (!P) notProved(`${name}: the exit of the tube before is not enclosed`);
  enter(prev, iv(prev.s), P, tube, name, 1);
}
function enter(prev, sg, pos, tube, name, sign) {
  const at = locate(tube, pos);
  if (at === 'out') refute(`${name}: the point where it is entered is not in it`);
  if (!at) notProved(`${name}: the point where it is entered is not seen to be in it`);
  const g = prev ? along(prev, sg, tube.c) * sign : 1;
  if (g < 0) refute(`${name}: leads the wrong way`); if (!g) notProved(`${name}: its direction is not seen`);
  return tube.entry = at;
}
function order(a, b, name) { if (a[0] >= b[1]) refute(name); if (!(a[1] < b[0])) notProved(name); }

// every sigma in [a, b]: t is not 1 there, or it is in a stretch with a solution on which dt/dsigma has one sign
function crossings(tube, a, b, marks, name) {
  const work = [[a, b, 0]]; let tries = 0;
  while (work.length) {
    const [x, y, depth] = work.pop();
    if (over(tube, [x, y]).every(A => { const v = phi(A, tube.S.m, paramOf(A, [x, y]), ONE); return v[0] > 0 || v[1] < 0; })) continue;
    if (marks.some(g => slopeT(tube, [Math.min(x, g[0]), Math.max(y, g[1])]) !== 0)) continue;
    const z = cut(x, y);
    if (z === null || depth > 60 || ++tries > 3000) {
      // t - 1 changes its sign certainly around here, and no listed solution is near?
      const w = (b - a) * 2 ** -16, p = Math.max(a, x - w), q = Math.min(b, y + w), sg = s => { const v = phi(over(tube, iv(s))[0], tube.S.m, paramOf(over(tube, iv(s))[0], iv(s)), ONE); return v[0] > 0 ? 1 : v[1] < 0 ? -1 : 0; };
      if (tube.allOut && sure(tube, p) && sure(tube, q) && sg(p) * sg(q) < 0 && marks.every(g => g[1] < p || g[0] > q)) refute(`${name}: t = 1 is met for sigma between ${p} and ${q}, and no solution is listed there`);
      notProved(`${name}: a point with t = 1 near sigma = ${x} is not seen to be a listed solution`);
    }
    work.push([z, y, depth + 1], [x, z, depth + 1]);
  }
}
function checkPath(C, log) {
  const { P } = C, from = P.dist.map(d => sketchSquare(P, d)), S = makeSystem(P, from, P.dist.map(d => d.sq), true), start = sketch(P);
  if (C.end === 0 && !C.ways[0].length) refute('there is no tube, and nothing is closed');
  C.sols.forEach((b, k) => proveBox(S, b, `solution ${k + 1}`));
  for (let i = 0; i < C.sols.length; i++) for (let j = 0; j < i; j++) if (!apart(C.sols[i], C.sols[j])) refute(`the boxes of solutions ${j + 1} and ${i + 1} overlap`);
  checkClasses(C);
  const met = C.sols.map(() => false), out = C.sols.map(() => true), closed = C.end === 0;
  let first = null, firstAt = null;
  C.ways.forEach((tubes, way) => {
    let prev = null;
    tubes.forEach((tube, k) => {
      const name = `tube ${tube.no}`, isLast = k === tubes.length - 1; let exit = iv(tube.s);
      proveTube(S, tube, name);
      if (prev) link(prev, tube, name);
      else {
        enter(way && first, firstAt, start, tube, name, -1);
        if (!way) { first = tube; firstAt = tube.entry; }
      }
      if (closed && isLast) {
        if (tubes.length < 2) refute('one tube alone closes no loop');
        const at = locate(tube, start);
        if (at === 'out') refute(`${name}: the sketch is not in the last tube`);
        if (!at) notProved(`${name}: the sketch is not seen to be in the last tube`);
        order(tube.entry, at, `${name}: the sketch has to be behind the entry`);
        const g = along(first, firstAt, tube.c); if (g < 0) refute(`${name}: closes in the wrong direction`); if (!g) notProved(`${name}: closing direction`);
        exit = at;
      } else order(tube.entry, exit, `${name}: is left before it is entered`);
      tube.exit = exit[0]; tube.allOut = true; const marks = [];
      C.sols.forEach((b, i) => {
        const at = locate(tube, b.pos);
        if (at === null) tube.allOut = false; if (at !== 'out') out[i] = false;
        if (!at || at === 'out') return;
        if (i < tube.behind) marks.push(at);
        if (closed || (at[0] >= tube.entry[1] && at[1] <= exit[0])) met[i] = true;
      });
      if (P.more1) checkPositive(P, tube, tube.entry[0], exit[1], name);
      crossings(tube, tube.entry[0], exit[1], marks, name);
      if (log) console.error(`${name}: ${tube.pieces.length} pieces`);
      if (prev && prev !== first) prev.pieces = null; prev = tube;
    });
  });
  met.forEach((v, i) => { if (!v && out[i]) refute(`solution ${i + 1} is on no tube`); if (!v) notProved(`solution ${i + 1} is not seen to be met by the path`); });
}
// same class: equal but for signs of coordinates; those of all axes but the last are told by the reference points
function checkClasses(C) {
  const { P } = C, mirror = mirrorHolds(P), own = P.own || [];
  let top = 0; C.classes.forEach((v, k) => { if (v > top) refute(`classes are not numbered in order: solution ${k + 1}`); if (v === top) top++; });
  const lead = []; for (let r = 1; r < P.ref.length; r++) lead.push(P.index[P.ref[r]][r - 1]);
  const num = (b, i) => add(fl(b.pos.x[i]), b.pos.off[i]), apart0 = w => w[0] > 0 || w[1] < 0;
  // reversals of directions and normals that leave the equations as they are
  if (own.length > 8) unsupported('more than 8 lines and planes of their own');
  const plain = Array(P.D).fill(1), turns = []; for (let k = 0; k < 1 << own.length; k++) { const rev = own.filter((_, j) => k >> j & 1).map(o => o.id); if (!rev.length || changeHolds(P, plain, rev)) turns.push(rev); }
  for (let i = 0; i < C.sols.length; i++) for (let j = 0; j < i; j++) {
    const A = C.sols[i], B = C.sols[j], flip = []; let known = true;
    for (const l of lead) { const a = num(A, l), b = num(B, l), s = v => v[0] > 0 ? 1 : v[1] < 0 ? -1 : 0; if (!s(a) || !s(b)) known = false; flip.push(s(a) * s(b)); }
    if (!known) notProved('classes: a reference point is not seen to be off an axis');
    let same = false, differ = true;
    for (const f of P.free ? [1] : [1, -1]) {
      const sg = P.free ? plain : [...flip, f]; if (!mirror && sg.reduce((x, y) => x * y) < 0) continue;
      for (const rev of turns) {
        const dv = Array.from({ length: P.m }, (_, k) => { const g = signOf(P, k, sg, rev); return sub(add(fl(BigInt(g) * A.pos.x[k] - B.alone.x[k]), scale(g, A.pos.off[k])), ZERO); });
        if (dv.every((v, k) => inside(v, B.alone.rho[k]))) same = true;
      }
      // another figure: other points, bases or radii; or a line or plane that is neither the same nor the same reversed
      const image = k => scale(signOf(P, k, sg), num(A, k)), other = (k, g) => apart0(sub(image(k), scale(g, num(B, k))));
      const shown = Array.from({ length: P.m }, (_, k) => k).some(k => (k < P.mX || P.more1.U[k - P.mX].base) && other(k, 1));
      if (!shown && !own.some(o => o.turn.some(k => other(k, 1)) && o.turn.some(k => other(k, -1)))) differ = false;
    }
    const said = C.classes[i] === C.classes[j], text = `classes of solutions ${j + 1} and ${i + 1}`;
    if (said ? differ : same) refute(text); if (said ? !same : !differ) notProved(text);
  }
}

// ---- Edits. ---------------------------------------------------------------------------------------------------
// dt/dsigma > 0 on [a, b]; where that is not seen: dt/dsigma falls (rises) there and is positive at the end (start)
function rises(tube, a, b, name) {
  const work = [[a, b, 0]];
  while (work.length) {
    const [x, y, depth] = work.pop();
    if (slopeT(tube, [x, y]) > 0) continue;
    const z = cut(x, y); if (z !== null && sure(tube, z) && slopeT(tube, iv(z)) < 0) refute(`${name}: t falls at sigma = ${z}`);
    if (z === null || depth > 40) notProved(`${name}: t is not seen to rise near sigma = ${x}`);
    work.push([z, y, depth + 1], [x, z, depth + 1]);
  }
}
function checkSigns(P, arc, tube, a, b, name) {
  const work = [[a, b, arc.signs, 0]];
  while (work.length) {
    const [x, y, list, depth] = work.pop();
    const left = list.filter(g => over(tube, [x, y]).some(A => !(determinant(P, A, paramOf(A, [x, y]), g) > 0)));
    if (!left.length) continue;
    const z = cut(x, y);
    if (z !== null && sure(tube, z)) for (const g of left) for (const A of over(tube, iv(z))) if (determinant(P, A, paramOf(A, iv(z)), g) < 0) refute(`${name}: the sign of points ${g.p} is another at sigma = ${z}`);
    if (z === null || depth > 30) notProved(`${name}: signs near sigma = ${x}`);
    work.push([z, y, left, depth + 1], [x, z, left, depth + 1]);
  }
}
function determinant(P, A, s, g) {                     // 1: has the sign of g; -1: the other; 0: unknown
  const at = g.p.map(p => P.index[p].map(i => i < 0 ? ZERO : phi(A, i, s, 0n)));
  const v = at.slice(1).map(r => r.map((x, k) => sub(x, at[0][k])));
  const d2 = (a, b, c, d) => sub(mul(a, d), mul(b, c));
  const r = P.D === 2 ? d2(v[0][0], v[0][1], v[1][0], v[1][1]) : [0, 1, 2].reduce((t, k) => add(t, mul(v[0][k], d2(v[1][(k + 1) % 3], v[1][(k + 2) % 3], v[2][(k + 1) % 3], v[2][(k + 2) % 3]))), ZERO);
  return (r[0] > 0 ? 1 : r[1] < 0 ? -1 : 0) * g.s;
}
function checkEdits(C, log) {
  const { P } = C; let now = null, start = sketch(P), numbers = P.more.map(([, c]) => c[c.length - 1]);
  C.arcs.forEach((arc, k) => {
    const what = `arc ${k + 1}`, leads = arc.led.size > 0;
    let from, to;
    if (!k && !leads) { from = P.dist.map(d => sketchSquare(P, d)); to = P.dist.map(d => d.sq); }
    else {
      from = now || P.dist.map(d => d.sq);
      if (!k && !P.distOnly) notProved(`${what}: a first arc that leads dimensions of a problem with more than distances`);
      if (!k) P.dist.forEach((d, i) => { const s = sketchSquare(P, d); if (s[0] * d.sq[1] !== d.sq[0] * s[1]) refute(`${what}: the sketch does not meet distance ${i}`); });
      to = from.map((v, i) => {
        if (!arc.led.has(i)) return v;
        const x = arc.led.get(i); return [x.n ** 2n, x.d ** 2n];
      });
    }
    const then = numbers.map((x, i) => arc.led.has(P.dist.length + i) ? arc.led.get(P.dist.length + i) : x);
    if (!P.distOnly) otherConstraints(P, { first: !k, from, to, now: numbers, then });
    numbers = then;
    const S = makeSystem(P, from, to, false), last = arc.tubes[arc.tubes.length - 1];
    let prev = null;
    for (const tube of arc.tubes) {
      const name = `${what}, tube ${tube.no}`; proveTube(S, tube, name);
      if (prev) link(prev, tube, name); else enter(null, null, start, tube, name, 1);
      let exit = tube.exit = tube.s;
      if (tube === last && arc.end) exit = arc.end.kind === 'reached' ? reached(S, tube, arc.end, name, start) : fold(S, tube, arc.end, name);
      else { order(tube.entry, iv(exit), `${name}: is left before it is entered`); rises(tube, tube.entry[0], exit, name); }
      if (P.more1) checkPositive(P, tube, tube.entry[0], exit, name);
      checkSigns(P, arc, tube, tube.entry[0], exit, name);
      if (log) console.error(`${name}: ${tube.pieces.length} pieces`);
      prev = tube;
    }
    now = to;
    if (arc.end && arc.end.kind === 'reached') { const p = arc.end.pos; start = { x: p.x.slice(), off: p.off }; start.x[P.m] = 0n; }
  });
}
function reached(S, tube, box, name) {
  proveBox(S, box, `${name}, the figure reached`);
  const at = locate(tube, box.pos);
  if (at === 'out') refute(`${name}: the figure reached is not in it`); if (!at) notProved(`${name}: the figure reached is not seen to be in it`);
  order(tube.entry, at, `${name}: the figure reached has to be behind the entry`);
  tube.exit = at[0]; rises(tube, tube.entry[0], at[1], name);
  return at[1];
}
function fold(S, tube, box, name) {
  // guess where dt/dsigma = 0, by halving
  let a = Math.max(-tube.h, tube.entry[1]), b = tube.h;
  const g = s => { const A = over(tube, iv(s))[0]; return mid(slope(A, S.m, paramOf(A, iv(s)))); };
  if (!(g(a) > 0 && g(b) < 0)) notProved(`${name}: dt/dsigma has no change of sign`);
  for (let k = 0; k < 60; k++) { const z = cut(a, b); if (z === null) break; if (g(z) > 0) a = z; else b = z; }
  // Newton's method for dt/dsigma = 0 in small pieces, then one on which both signs are seen
  let N = null, w = 0;
  const small = del => { const A = over(tube, iv(a))[0], B = a - del > -tube.h && a + del < tube.h && test(S, tube, near(A, a), a, del, A.rho.map(v => v / 4)); return B && !B.failed && joined(A, B, iv(a)) ? B : null; };
  for (let k = 0; k < 4 && (N = small(1e-4 * tube.h)); k++) a -= mid(slope(N, S.m, ZERO)) / (2 * N.d[2][S.m]) * N.del * N.del;
  for (w = 1e-15 * tube.h; w < 0.1 * tube.h; w *= 2) {
    N = small(2 * w);
    if (N && slope(N, S.m, paramOf(N, iv(a - w)))[0] > 0 && slope(N, S.m, paramOf(N, iv(a + w)))[1] < 0) break;
    N = null;
  }
  if (!N) notProved(`${name}: the fold is not enclosed`);
  const p = a - w, q = a + w; order(tube.entry, iv(p), `${name}: the fold has to be behind the entry`);
  const s = paramOf(N, [p, q]); tube.exit = p;
  box.mid.forEach((v, i) => { const d = phi(N, i, s, fix(v)); if (d[0] > box.radius || d[1] < -box.radius) refute(`${name}: the fold is elsewhere`); if (!(d[0] >= -box.radius && d[1] <= box.radius)) notProved(`${name}: the fold is not seen to be within its radius (off by up to ${mag(d)}, radius ${box.radius})`); });
  const dt = phi(N, S.m, s, fix(box.t)); if (dt[0] > box.tr || dt[1] < -box.tr) refute(`${name}: t at the fold is another`); if (!(dt[0] >= -box.tr && dt[1] <= box.tr)) notProved(`${name}: t at the fold`);
  if (!(phi(N, S.m, s, ONE)[1] < 0)) notProved(`${name}: t at the fold is not seen to be below 1`);
  // d^2t/dsigma^2 < 0 on [x, q], so dt/dsigma > 0 on [x, p], one zero between p and q; and dt/dsigma > 0 from the entry to x
  for (let l = (a - Math.max(-tube.h, tube.entry[0])); l > w; l /= 2) {
    const x = Math.max(a - l, tube.entry[0]);
    if (over(tube, [x, q]).every(A => curvature(A, paramOf(A, [x, q]))[1] < 0)) { rises(tube, tube.entry[0], x, name); return q; }
  }
  notProved(`${name}: d^2t/dsigma^2 < 0 is not seen`);
}

// ---- Main. ----------------------------------------------------------------------------------------------------
const WORD = { 0: 'VERIFIED', 1: 'REFUTED', 2: 'NO CERTIFICATE', 3: 'NOT PROVED', 4: 'INCOMPLETE', 5: 'unsupported' };
function check(buf, log) {
  try {
    const C = read(buf);
    if (C.kind === 'edits') checkEdits(C, log); else checkPath(C, log);
    const sum = C.kind === 'edits' ? `${C.arcs.length} arcs, ${C.arcs.map(a => a.end ? a.end.kind : 'stopped').join(', ')}` : `${C.sols.length} solutions in ${new Set(C.classes).size} classes, ${['closed', 'stopped', 'open'][C.end]}`;
    return { code: C.end === 1 ? 4 : 0, text: `${C.tubes} tubes, ${sum}` };
  } catch (err) { return err instanceof Verdict ? { code: err.code, text: err.message } : { code: 3, text: `an error of this checker: ${err.stack}` }; }
}
module.exports = { check, read, readProblem, otherConstraints, sketch, sketchSquare, makeSystem, proveTube, locate, near, over, proveBox, newton, slopeT, phi, paramOf, fix, fl, ONE, mid };
if (require.main === module) {
  let buf; const file = process.argv[2];
  try { buf = fs.readFileSync(file); } catch { console.log('NO CERTIFICATE: cannot be read'); process.exit(2); }
  const v = check(buf, process.argv.includes('-v'));
  console.log(`${WORD[v.code]}: ${v.text}`); process.exit(v.code);
}
