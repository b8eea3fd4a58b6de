// Samples a tetrahedron and prints the points, by the functions of geodisk/geodisk.h:
//     mcs Sample.cs && mono Sample.exe        (or as a project of .NET or Unity)
// Structs have the fields of the header, in its order, up to the last that is needed: their
// StructSize says how far they go.
using System;
using System.Globalization;
using System.Runtime.InteropServices;
using System.Text;

static class Geodisk
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Error
    {
        public UIntPtr StructSize;
        public int Status;
        public int VkResult;
        public ulong Element;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 1024)]
        public byte[] Message; // UTF-8, ended by a zero.
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct MeshParams
    {
        public UIntPtr StructSize;
        public IntPtr Positions;
        public int PositionType; // 0: double, 1: float.
        public uint Dimension;
        public UIntPtr VertexCount;
        public UIntPtr PositionStride;
        public IntPtr Indices;
        public int IndexType; // 0 or 2: uint, 3: ushort.
        public UIntPtr FaceCount;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct SurfaceParams
    {
        public UIntPtr StructSize;
        public double MinDistance;
        public ulong Seed;
    }

    public const int Position = 2; // GEODISK_POSITION.
    public const int Float64 = 0;  // GEODISK_FLOAT64.

    const string Library = "geodisk"; // libgeodisk.so, libgeodisk.dylib or geodisk.dll.

    [DllImport(Library)]
    public static extern int geodisk_device_open(IntPtr options, out IntPtr device, ref Error error);
    [DllImport(Library)]
    public static extern int geodisk_sampler_create(IntPtr device, IntPtr options, out IntPtr sampler,
                                                    ref Error error);
    [DllImport(Library)]
    public static extern int geodisk_mesh_create(ref MeshParams shape, out IntPtr mesh, ref Error error);
    [DllImport(Library)]
    public static extern int geodisk_domain_surface(IntPtr mesh, ref SurfaceParams job, out IntPtr domain,
                                                    ref Error error);
    [DllImport(Library)]
    public static extern int geodisk_sample(IntPtr sampler, IntPtr domain, IntPtr progress, IntPtr user,
                                            out IntPtr samples, ref Error error);
    [DllImport(Library)]
    public static extern UIntPtr geodisk_samples_count(IntPtr samples);
    [DllImport(Library)]
    public static extern int geodisk_samples_copy(IntPtr samples, int attribute, int type, double[] data,
                                                  UIntPtr stride, UIntPtr capacity, ref Error error);
    [DllImport(Library)]
    public static extern void geodisk_device_release(IntPtr device);
    [DllImport(Library)]
    public static extern void geodisk_sampler_release(IntPtr sampler);
    [DllImport(Library)]
    public static extern void geodisk_mesh_release(IntPtr mesh);
    [DllImport(Library)]
    public static extern void geodisk_domain_release(IntPtr domain);
    [DllImport(Library)]
    public static extern void geodisk_samples_release(IntPtr samples);

    public static UIntPtr SizeOf<T>()
    {
        return (UIntPtr)(ulong)Marshal.SizeOf(typeof(T));
    }
}

static class Program
{
    static Geodisk.Error error = new Geodisk.Error { StructSize = Geodisk.SizeOf<Geodisk.Error>() };

    // Throws what a call failed with.
    static void Check(int status)
    {
        if (status == 0) return;
        int length = Array.IndexOf(error.Message, (byte)0);
        throw new InvalidOperationException(Encoding.UTF8.GetString(error.Message, 0, length));
    }

    static void Main()
    {
        double[] positions = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
        uint[] indices = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
        // The arrays stay where they are until the mesh is made, which copies what it needs.
        GCHandle heldPositions = GCHandle.Alloc(positions, GCHandleType.Pinned);
        GCHandle heldIndices = GCHandle.Alloc(indices, GCHandleType.Pinned);
        var shape = new Geodisk.MeshParams
        {
            StructSize = Geodisk.SizeOf<Geodisk.MeshParams>(),
            Positions = heldPositions.AddrOfPinnedObject(),
            VertexCount = (UIntPtr)4,
            Indices = heldIndices.AddrOfPinnedObject(),
            FaceCount = (UIntPtr)4,
        };
        var job = new Geodisk.SurfaceParams
        {
            StructSize = Geodisk.SizeOf<Geodisk.SurfaceParams>(),
            MinDistance = 0.2,
            Seed = 7,
        };
        IntPtr device, sampler, mesh, domain, samples;
        Check(Geodisk.geodisk_device_open(IntPtr.Zero, out device, ref error));
        Check(Geodisk.geodisk_sampler_create(device, IntPtr.Zero, out sampler, ref error));
        Check(Geodisk.geodisk_mesh_create(ref shape, out mesh, ref error));
        heldPositions.Free();
        heldIndices.Free();
        Check(Geodisk.geodisk_domain_surface(mesh, ref job, out domain, ref error));
        Check(Geodisk.geodisk_sample(sampler, domain, IntPtr.Zero, IntPtr.Zero, out samples, ref error));

        int count = (int)Geodisk.geodisk_samples_count(samples);
        double[] points = new double[3 * count];
        Check(Geodisk.geodisk_samples_copy(samples, Geodisk.Position, Geodisk.Float64, points, UIntPtr.Zero,
                                           (UIntPtr)(ulong)count, ref error));
        Console.WriteLine(count + " samples");
        for (int i = 0; i < points.Length; i += 3)
        {
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture, "{0} {1} {2}", points[i],
                                            points[i + 1], points[i + 2]));
        }

        Geodisk.geodisk_samples_release(samples);
        Geodisk.geodisk_domain_release(domain);
        Geodisk.geodisk_mesh_release(mesh);
        Geodisk.geodisk_sampler_release(sampler);
        Geodisk.geodisk_device_release(device);
    }
}
