//! The shell that QEMU loads: its interface is C, in `qemu-plugin.h`, of which the few functions that are needed are declared here.
//!
//! The interface has versions. This is version 1, of QEMU 6.0 to 8.2; a later QEMU says that it wants a newer one and does not start.

use crate::account::Account;
use std::ffi::{CStr, c_char, c_int, c_uint, c_void};
use std::fmt::Write;
use std::path::PathBuf;
use std::ptr;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// The version of the interface, which QEMU reads.
#[unsafe(no_mangle)]
static qemu_plugin_version: c_int = 1;

/// The callbacks touch no register of the processor.
const NO_REGISTERS: c_int = 0;

/// A block of code that QEMU translates.
#[repr(C)]
struct Block {
    _opaque: [u8; 0],
}

/// An instruction of a block.
#[repr(C)]
struct Handle {
    _opaque: [u8; 0],
}

unsafe extern "C" {
    fn qemu_plugin_register_vcpu_tb_trans_cb(id: u64, call: extern "C" fn(u64, *mut Block));
    fn qemu_plugin_register_atexit_cb(id: u64, call: extern "C" fn(u64, *mut c_void), data: *mut c_void);
    fn qemu_plugin_register_vcpu_insn_exec_cb(
        instruction: *mut Handle,
        call: extern "C" fn(c_uint, *mut c_void),
        flags: c_int,
        data: *mut c_void,
    );
    fn qemu_plugin_tb_n_insns(block: *const Block) -> usize;
    fn qemu_plugin_tb_get_insn(block: *const Block, index: usize) -> *mut Handle;
    fn qemu_plugin_insn_data(instruction: *const Handle) -> *const u8;
    fn qemu_plugin_insn_size(instruction: *const Handle) -> usize;
    fn qemu_plugin_insn_vaddr(instruction: *const Handle) -> u64;
}

static ACCOUNT: Mutex<Account> = Mutex::new(Account::new());
static OUT: OnceLock<PathBuf> = OnceLock::new();

fn account() -> MutexGuard<'static, Account> {
    ACCOUNT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// QEMU calls this once, before anything runs, with `out=FILE` as the argument; 0 is success.
///
/// # Safety
///
/// `arguments` are `count` strings that end with a zero byte.
#[unsafe(no_mangle)]
unsafe extern "C" fn qemu_plugin_install(
    id: u64,
    _about: *const c_void,
    count: c_int,
    arguments: *const *const c_char,
) -> c_int {
    let argument = |index: usize| {
        // SAFETY: `index` is below `count`, of which QEMU passes so many strings, which live through this call.
        unsafe { CStr::from_ptr(*arguments.add(index)) }.to_string_lossy().into_owned()
    };
    let arguments: Vec<String> = (0..usize::try_from(count).unwrap_or(0)).map(argument).collect();
    let [argument] = &arguments[..] else { return refuse(&arguments) };
    let Some(path) = argument.strip_prefix("out=") else { return refuse(&arguments) };
    if OUT.set(path.into()).is_err() {
        return refuse(&["loaded twice".into()]);
    }
    // SAFETY: `id` is what QEMU has just given, and the functions have the types that the interface says.
    unsafe {
        qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
        qemu_plugin_register_atexit_cb(id, end, ptr::null_mut());
    }
    0
}

fn refuse(arguments: &[String]) -> c_int {
    eprintln!("fluisim-cycles: expected one argument, out=FILE, got {arguments:?}");
    1
}

/// QEMU has translated a block: asks to be called for each of its instructions.
extern "C" fn translated(_id: u64, block: *mut Block) {
    // SAFETY: the block and its instructions are alive during this call; each index is below their number; an instruction's data
    // are as many bytes as its size says.
    unsafe {
        for index in 0..qemu_plugin_tb_n_insns(block) {
            let handle = qemu_plugin_tb_get_insn(block, index);
            let bytes =
                std::slice::from_raw_parts(qemu_plugin_insn_data(handle), qemu_plugin_insn_size(handle));
            let number = learn(qemu_plugin_insn_vaddr(handle) as u32, bytes);
            let data = ptr::without_provenance_mut(number); // handed back, never read
            qemu_plugin_register_vcpu_insn_exec_cb(handle, executed, NO_REGISTERS, data);
        }
    }
}

/// The number of an instruction that lies at an address, from its bytes.
fn learn(address: u32, bytes: &[u8]) -> usize {
    let halfword = |at: usize| match bytes.get(at..at + 2) {
        Some(&[low, high]) => u16::from_le_bytes([low, high]),
        _ => 0, // a narrow one has no second
    };
    account().learn(address, halfword(0), halfword(2))
}

/// QEMU is about to execute an instruction.
extern "C" fn executed(_processor: c_uint, data: *mut c_void) {
    account().execute(data.addr());
}

/// QEMU ends: writes a line for each region.
extern "C" fn end(_id: u64, _data: *mut c_void) {
    let mut lines = String::new();
    for totals in account().regions() {
        let _ = writeln!(lines, "{totals}"); // a String takes everything
    }
    let Some(path) = OUT.get() else { return };
    if let Err(error) = std::fs::write(path, lines) {
        eprintln!("fluisim-cycles: cannot write {}: {error}", path.display());
    }
}
