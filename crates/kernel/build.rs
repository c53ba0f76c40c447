//! Chooses the interval arithmetic: inari's where the program is built for a processor that has what inari
//! needs, krawl's own elsewhere; the dependency on inari in Cargo.toml has the same condition.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(hardware_intervals)");
    let features = std::env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    let has = |name: &str| features.split(',').any(|feature| feature == name);
    match std::env::var("CARGO_CFG_TARGET_ARCH").as_deref() {
        Ok("aarch64") => println!("cargo::rustc-cfg=hardware_intervals"),
        Ok("x86_64") if has("avx") && has("fma") => {
            println!("cargo::rustc-cfg=hardware_intervals");
            if std::env::var("HOST") == std::env::var("TARGET") && !host_has_avx_and_fma() {
                println!(
                    "cargo::error=This build is for processors with AVX and FMA instructions (Intel \
                     Haswell, AMD Zen, or later), and this machine's processor does not have them. \
                     The flag that asks for them is in .cargo/config.toml, or in RUSTFLAGS: without \
                     it krawl is slower and needs neither."
                );
            }
        }
        Ok("x86_64") => println!(
            "cargo::warning=krawl is built without AVX and FMA instructions and is several times \
             slower for it. For processors since about 2013 set RUSTFLAGS=-Ctarget-cpu=x86-64-v3, or \
             put it into your .cargo/config.toml as krawl's own does."
        ),
        _ => (),
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
