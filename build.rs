//! Says plainly, before anything else fails, what the interval arithmetic needs of the machine.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_ARCH").as_deref() != Ok("x86_64") {
        return;
    }
    let features = std::env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    let has = |name: &str| features.split(',').any(|feature| feature == name);
    if !(has("avx") && has("fma")) {
        println!(
            "cargo::error=krawl's proofs need AVX and FMA instructions, and this build does not \
             enable them. They are set in .cargo/config.toml; a RUSTFLAGS variable in your \
             environment replaces that file's flags. Unset it, or add -Ctarget-cpu=x86-64-v3 to it."
        );
    }
    if std::env::var("HOST") == std::env::var("TARGET") && !host_has_avx_and_fma() {
        println!(
            "cargo::error=krawl's proofs need a processor with AVX and FMA instructions (Intel \
             Haswell, AMD Zen, or later), and this machine's processor does not have them."
        );
    }
}

/// Asks the processor itself: `is_x86_feature_detected!` answers from the build's flags.
#[cfg(target_arch = "x86_64")]
fn host_has_avx_and_fma() -> bool {
    // CPUID leaf 1, ECX: bit 12 is FMA, bit 28 is AVX.
    #[allow(unused_unsafe)] // a safe intrinsic since Rust 1.89
    let ecx = unsafe { std::arch::x86_64::__cpuid(1) }.ecx;
    ecx & (1 << 12) != 0 && ecx & (1 << 28) != 0
}

#[cfg(not(target_arch = "x86_64"))]
fn host_has_avx_and_fma() -> bool {
    true
}
