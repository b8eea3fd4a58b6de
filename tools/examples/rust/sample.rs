// Samples a tetrahedron and prints the points, by the functions of geodisk/geodisk.h:
//     rustc sample.rs -L LIBDIR && ./sample
use std::ffi::{c_char, c_void, CStr};
use std::mem::size_of;
use std::ptr::{null, null_mut};

#[repr(C)]
struct Error {
    struct_size: usize,
    status: i32,
    vk_result: i32,
    element: u64,
    message: [c_char; 1024],
}

#[repr(C)]
struct MeshParams {
    struct_size: usize,
    positions: *const c_void,
    position_type: i32,
    dimension: u32,
    vertex_count: usize,
    position_stride: usize,
    indices: *const c_void,
    index_type: i32,
    face_count: usize,
} // The rest is not needed here: it is as struct_size tells.

#[repr(C)]
struct SurfaceParams {
    struct_size: usize,
    min_distance: f64,
    seed: u64,
}

const POSITION: i32 = 2;
const FLOAT64: i32 = 0;

#[link(name = "geodisk")]
extern "C" {
    fn geodisk_device_open(options: *const c_void, device: *mut *mut c_void, error: *mut Error) -> i32;
    fn geodisk_sampler_create(
        device: *const c_void, options: *const c_void, sampler: *mut *mut c_void, error: *mut Error,
    ) -> i32;
    fn geodisk_mesh_create(params: *const MeshParams, mesh: *mut *mut c_void, error: *mut Error) -> i32;
    fn geodisk_domain_surface(
        mesh: *const c_void, params: *const SurfaceParams, domain: *mut *mut c_void, error: *mut Error,
    ) -> i32;
    fn geodisk_sample(
        sampler: *mut c_void, domain: *const c_void, progress: *const c_void, user: *mut c_void,
        samples: *mut *mut c_void, error: *mut Error,
    ) -> i32;
    fn geodisk_samples_count(samples: *const c_void) -> usize;
    fn geodisk_samples_copy(
        samples: *const c_void, attribute: i32, kind: i32, data: *mut f64, stride: usize,
        capacity: usize, error: *mut Error,
    ) -> i32;
    fn geodisk_device_release(device: *mut c_void);
    fn geodisk_sampler_release(sampler: *mut c_void);
    fn geodisk_mesh_release(mesh: *mut c_void);
    fn geodisk_domain_release(domain: *mut c_void);
    fn geodisk_samples_release(samples: *mut c_void);
}

/// Ends the program with the message of a call that failed.
fn check(status: i32, error: &Error) {
    if status != 0 {
        let message = unsafe { CStr::from_ptr(error.message.as_ptr()) };
        eprintln!("{}", message.to_string_lossy());
        std::process::exit(1);
    }
}

fn main() {
    let positions: [f64; 12] = [1., 1., 1., 1., -1., -1., -1., 1., -1., -1., -1., 1.];
    let indices: [u32; 12] = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2];
    let mut error = Error { struct_size: size_of::<Error>(), status: 0, vk_result: 0, element: 0, message: [0; 1024] };
    let e: *mut Error = &mut error;
    let shape = MeshParams {
        struct_size: size_of::<MeshParams>(),
        positions: positions.as_ptr().cast(),
        position_type: FLOAT64,
        dimension: 3,
        vertex_count: 4,
        position_stride: 0,
        indices: indices.as_ptr().cast(),
        index_type: 0,
        face_count: 4,
    };
    let job = SurfaceParams { struct_size: size_of::<SurfaceParams>(), min_distance: 0.2, seed: 7 };
    unsafe {
        let (mut device, mut sampler, mut mesh) = (null_mut(), null_mut(), null_mut());
        let (mut domain, mut samples) = (null_mut(), null_mut());
        check(geodisk_device_open(null(), &mut device, e), &*e);
        check(geodisk_sampler_create(device, null(), &mut sampler, e), &*e);
        check(geodisk_mesh_create(&shape, &mut mesh, e), &*e);
        check(geodisk_domain_surface(mesh, &job, &mut domain, e), &*e);
        check(geodisk_sample(sampler, domain, null(), null_mut(), &mut samples, e), &*e);
        let count = geodisk_samples_count(samples);
        let mut points = vec![0f64; 3 * count];
        check(geodisk_samples_copy(samples, POSITION, FLOAT64, points.as_mut_ptr(), 0, count, e), &*e);
        println!("{count} samples");
        for p in points.chunks(3) {
            println!("{} {} {}", p[0], p[1], p[2]);
        }
        geodisk_samples_release(samples);
        geodisk_domain_release(domain);
        geodisk_mesh_release(mesh);
        geodisk_sampler_release(sampler);
        geodisk_device_release(device);
    }
}
