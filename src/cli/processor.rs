//! Whether this processor has the instructions that the program was built for.

/// Says plainly what is missing, before the first such instruction ends the program with a signal.
#[inline(never)]
pub fn check() -> Result<(), String> {
    let missing = missing();
    if missing.is_empty() {
        return Ok(());
    }
    Err(format!(
        "this processor lacks {}: krawl's proofs round with these instructions (Intel Haswell, \
         AMD Zen, or later)",
        missing.join(", ")
    ))
}

/// Asks the processor itself: `is_x86_feature_detected!` answers from the build's flags.
#[cfg(target_arch = "x86_64")]
fn missing() -> Vec<&'static str> {
    use std::arch::x86_64::{__cpuid, __cpuid_count};
    // A safe intrinsic since Rust 1.94, and an unsafe one before: every x86-64 has CPUID.
    #[allow(unused_unsafe)]
    let (highest, leaf1) = unsafe { (__cpuid(0).eax, __cpuid(1).ecx) };
    #[allow(unused_unsafe)]
    let leaf7 = if highest >= 7 {
        unsafe { __cpuid_count(7, 0) }.ebx
    } else {
        0
    };
    let bit = |register: u32, bit: u32| register & (1 << bit) != 0;
    // AVX needs the operating system too, which says so by OSXSAVE. The others come from the
    // build's flags (x86-64-v3) and are asked for only where the build uses them.
    [
        ("AVX", bit(leaf1, 28) && bit(leaf1, 27)),
        ("FMA", bit(leaf1, 12)),
        ("AVX2", bit(leaf7, 5) || !cfg!(target_feature = "avx2")),
        ("BMI2", bit(leaf7, 8) || !cfg!(target_feature = "bmi2")),
    ]
    .into_iter()
    .filter(|&(_, there)| !there)
    .map(|(name, _)| name)
    .collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn missing() -> Vec<&'static str> {
    Vec::new()
}
