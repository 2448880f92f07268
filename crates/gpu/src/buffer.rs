//! Buffers.

use std::{
    ops::{Bound, Range, RangeBounds},
    ptr::NonNull,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU32, Ordering},
    },
};

use ash::vk;
use bytemuck::{NoUninit, Pod};
use gpu_allocator::MemoryLocation;

use crate::{
    Device, GpuError, Recording, TexelFormat, info::TRANSFORM_FEEDBACK, memory::Block, owned::Owned,
    resource::ResourceId, texels::TexelViews,
};

bitflags::bitflags! {
    /// What a buffer is for; copying from and to it is always allowed.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct BufferUsage: u32 {
        /// Storage buffer of a shader.
        const STORAGE = 1;
        /// Uniform buffer of a shader.
        const UNIFORM = 2;
        /// Index buffer of a draw.
        const INDEX = 4;
        /// Target of a capture pass; needs transform feedback.
        const CAPTURE = 8;
        /// Attributes of a draw's vertices.
        const VERTEX = 16;
        /// Array of vectors that shaders read: see [`TexelFormat`](crate::TexelFormat).
        const TEXELS = 32;
    }
}

/// Where a buffer lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Memory {
    /// Fastest for the device. Filled by [`Device::upload`] or by passes, read by [`Device::download`].
    #[default]
    Device,
    /// Written by the host with [`Buffer::write`], often.
    Upload,
    /// Written by passes, read by the host with [`Buffer::read`].
    Readback,
}

/// How to make a buffer.
#[derive(Clone, Copy, Debug)]
pub struct BufferDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// Size in bytes; may be 0.
    pub size: u64,
    /// What it is for.
    pub usage: BufferUsage,
    /// Where it lives.
    pub memory: Memory,
}

/// A piece of memory that shaders and passes use. Clones share it.
///
/// Threads may use one buffer at the same time: writes and reads by the host and submissions that use the buffer follow one
/// another, in an order of their choice. While one thread waits in [`Self::write`] or [`Self::read`], others that submit work
/// with this buffer wait too.
#[derive(Clone)]
pub struct Buffer {
    inner: Arc<Inner>,
}

/// Field order is destruction order: views before the buffer, and that before its memory.
struct Inner {
    texels: TexelViews,
    raw: Owned<vk::Buffer>,
    block: Block,
    id: ResourceId,
    name: String,
    size: u64,
    /// Bytes that Vulkan knows of: at least one word, so that empty buffers can be bound.
    real_size: u64,
    usage: BufferUsage,
    memory: Memory,
    /// Timeline value of the last submission that uses the buffer. Locked as long as the host touches the content, and while
    /// a submission that uses the buffer is on its way; see `submission` for the order of locks.
    last_use: Mutex<u64>,
    /// How many pieces of encoded commands hold it. Rises only while `last_use` is locked.
    held: AtomicU32,
    device: Device,
}

impl Device {
    /// Makes a buffer. What is in it is undefined until written.
    pub fn buffer(&self, desc: &BufferDesc<'_>) -> Result<Buffer, GpuError> {
        if desc.usage.contains(BufferUsage::CAPTURE) && !self.info().features.transform_feedback {
            return Err(self.missing(format!("buffer {:?}", desc.name), TRANSFORM_FEEDBACK));
        }
        let limit = self.info().limits.max_memory_allocation;
        if desc.size > limit {
            return Err(GpuError::Limit {
                what: format!("size of buffer {:?} in bytes", desc.name),
                value: desc.size,
                limit,
            });
        }
        // A view holds at least one vector.
        let least = if desc.usage.contains(BufferUsage::TEXELS) { TexelFormat::MOST_BYTES } else { 4 };
        let real_size = desc.size.max(least).next_multiple_of(4);
        let info = vk::BufferCreateInfo::default().size(real_size).usage(usage_flags(desc.usage));
        // SAFETY: the size is not zero and the usage is one the device has.
        let raw = unsafe { self.raw().create_buffer(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating buffer {:?}", desc.name), result))?;
        let raw = Owned::new(&self.shared.raw, raw, desc.name);
        // SAFETY: the buffer was made by this device.
        let requirements = unsafe { self.raw().get_buffer_memory_requirements(raw.raw) };
        let location = match desc.memory {
            Memory::Device => MemoryLocation::GpuOnly,
            Memory::Upload => MemoryLocation::CpuToGpu,
            Memory::Readback => MemoryLocation::GpuToCpu,
        };
        let block = self.shared.memory.allocate(desc.name, requirements, location, true)?;
        let (memory, offset) = block.place();
        // SAFETY: buffer and memory are of this device, the memory meets the buffer's requirements and outlives it, since
        // `Inner` drops it later.
        unsafe { self.raw().bind_buffer_memory(raw.raw, memory, offset) }
            .map_err(|result| GpuError::from_vulkan(format!("binding memory to buffer {:?}", desc.name), result))?;
        let inner = Inner {
            texels: TexelViews::default(),
            raw,
            block,
            id: ResourceId::new(),
            name: desc.name.to_owned(),
            size: desc.size,
            real_size,
            usage: desc.usage,
            memory: desc.memory,
            last_use: Mutex::new(0),
            held: AtomicU32::new(0),
            device: self.clone(),
        };
        Ok(Buffer { inner: Arc::new(inner) })
    }

    /// Makes a buffer in device memory that holds `data`. Goes through a staging buffer and waits for it, unless the host sees
    /// the device's memory, as on llvmpipe.
    pub fn upload<T: NoUninit>(&self, name: &str, usage: BufferUsage, data: &[T]) -> Result<Buffer, GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let size = bytes.len() as u64;
        let buffer = self.buffer(&BufferDesc { name, size, usage, memory: Memory::Device })?;
        if buffer.inner.block.mapped().is_some() {
            buffer.write_bytes(0, bytes)?;
        } else if size > 0 {
            let staging = self.staging(name, size, Memory::Upload)?;
            staging.write_bytes(0, bytes)?;
            self.copy_now(&staging, 0..size, &buffer)?;
        }
        Ok(buffer)
    }

    /// Reads bytes of any buffer, through a staging buffer, and waits for it. `bytes` must hold whole elements.
    pub fn download<T: Pod>(&self, buffer: &Buffer, bytes: impl RangeBounds<u64>) -> Result<Vec<T>, GpuError> {
        let range = buffer.resolve(bytes, "a download")?;
        let size = range.end - range.start;
        if size == 0 {
            return Ok(Vec::new());
        }
        let staging = self.staging(buffer.name(), size, Memory::Readback)?;
        self.copy_now(buffer, range, &staging)?;
        staging.read(..size)
    }

    pub(crate) fn staging(&self, name: &str, size: u64, memory: Memory) -> Result<Buffer, GpuError> {
        let name = format!("staging of {name}");
        self.buffer(&BufferDesc { name: &name, size, usage: BufferUsage::empty(), memory })
    }

    fn copy_now(&self, source: &Buffer, range: Range<u64>, target: &Buffer) -> Result<(), GpuError> {
        let mut recording = Recording::new();
        recording.copy_buffer(source, range, target, 0);
        self.submit(&recording)?.wait().map(drop)
    }
}

impl Buffer {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Size in bytes.
    pub fn size(&self) -> u64 {
        self.inner.size
    }

    /// What it is for.
    pub fn usage(&self) -> BufferUsage {
        self.inner.usage
    }

    /// Where it lives.
    pub fn memory(&self) -> Memory {
        self.inner.memory
    }

    /// Writes `data` at `offset` bytes. Only for [`Memory::Upload`]. Waits until submissions that use the buffer are done; later
    /// ones, by any thread, see all of it. Fails while commands hold the buffer that [`Device::encode`] has written.
    pub fn write<T: NoUninit>(&self, offset: u64, data: &[T]) -> Result<(), GpuError> {
        if self.inner.memory != Memory::Upload {
            return Err(self.misuse("writing by the host", "it is not in upload memory; use Device::upload or a copy"));
        }
        self.write_bytes(offset, bytemuck::cast_slice(data))
    }

    /// Reads a range of bytes as elements. Only for [`Memory::Readback`]. Waits until submissions that use the buffer are done.
    pub fn read<T: Pod>(&self, bytes: impl RangeBounds<u64>) -> Result<Vec<T>, GpuError> {
        const WHAT: &str = "reading by the host";
        if self.inner.memory != Memory::Readback {
            return Err(self.misuse(WHAT, "it is not in readback memory; use Device::download or a copy"));
        }
        let range = self.resolve(bytes, WHAT)?;
        let size = size_of::<T>() as u64;
        let count = (range.end - range.start).checked_div(size).unwrap_or(0);
        if count * size != range.end - range.start {
            return Err(self.misuse(WHAT, "the range does not hold whole elements"));
        }
        let mut data = vec![T::zeroed(); usize::try_from(count).unwrap_or(usize::MAX)];
        self.read_bytes(range.start, bytemuck::cast_slice_mut(&mut data))?;
        Ok(data)
    }

    /// Copies host bytes into memory that the host sees.
    fn write_bytes(&self, offset: u64, bytes: &[u8]) -> Result<(), GpuError> {
        const WHAT: &str = "writing by the host";
        let target = self.mapped(offset, bytes.len(), WHAT)?;
        let _idle = self.idle(WHAT)?;
        // SAFETY: `mapped` checked that as many bytes as the slice has lie at `target` in this buffer's mapped memory, which
        // lives as long as self; the two cannot overlap, since the mapping is never lent out. While `_idle` lives, neither the
        // GPU nor another thread touches the content; the GPU sees host writes that come before a submission.
        unsafe { target.copy_from_nonoverlapping(NonNull::from(bytes).cast(), bytes.len()) };
        self.inner.device.shared.memory.count_written(bytes.len() as u64);
        Ok(())
    }

    /// Copies bytes from memory that the host sees.
    fn read_bytes(&self, offset: u64, bytes: &mut [u8]) -> Result<(), GpuError> {
        const WHAT: &str = "reading by the host";
        let source = self.mapped(offset, bytes.len(), WHAT)?;
        let _idle = self.idle(WHAT)?;
        let length = bytes.len();
        // SAFETY: as in `write_bytes`, with the roles exchanged; a submission ends by making its writes visible to the host.
        unsafe { source.copy_to_nonoverlapping(NonNull::from(bytes).cast(), length) };
        Ok(())
    }

    /// Where the host sees `length` bytes at `offset`.
    fn mapped(&self, offset: u64, length: usize, what: &str) -> Result<NonNull<u8>, GpuError> {
        let end = offset.saturating_add(length as u64);
        self.check(offset..end, what)?;
        let pointer = self.inner.block.mapped().ok_or_else(|| self.misuse(what, "the host does not see its memory"))?;
        // SAFETY: `check` found that the range ends within the buffer, and the mapping covers the whole of it.
        Ok(unsafe { pointer.add(usize::try_from(offset).unwrap_or(usize::MAX)) })
    }

    /// Waits until the GPU is done with the buffer. While the guard lives, the content belongs to this thread alone.
    fn idle(&self, what: &str) -> Result<MutexGuard<'_, u64>, GpuError> {
        let last_use = self.lock();
        if self.inner.held.load(Ordering::Acquire) > 0 {
            let (name, instead) = (self.name().to_owned(), "Recording::write and Recording::copy_buffer");
            return Err(GpuError::InUse { name, instead });
        }
        self.inner.device.wait_for(*last_use, what)?;
        Ok(last_use)
    }

    /// Keeps the host off the content until [`Self::release`], which is to be called as often.
    pub(crate) fn hold(&self) {
        let _last_use = self.lock();
        self.inner.held.fetch_add(1, Ordering::AcqRel);
    }

    pub(crate) fn release(&self) {
        self.inner.held.fetch_sub(1, Ordering::AcqRel);
    }

    /// Keeps the host off the content, and other submissions. The value is that of the timeline after the last submission
    /// that uses the buffer; it is right after a panic elsewhere too, since it changes only after a submission.
    pub(crate) fn lock(&self) -> MutexGuard<'_, u64> {
        self.inner.last_use.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The bytes that a range of any form means.
    pub(crate) fn resolve(&self, bytes: impl RangeBounds<u64>, what: &str) -> Result<Range<u64>, GpuError> {
        let start = match bytes.start_bound() {
            Bound::Included(&start) => start,
            Bound::Excluded(&start) => start.saturating_add(1),
            Bound::Unbounded => 0,
        };
        let end = match bytes.end_bound() {
            Bound::Included(&end) => end.saturating_add(1),
            Bound::Excluded(&end) => end,
            Bound::Unbounded => self.size(),
        };
        self.check(start..end, what)?;
        Ok(start..end)
    }

    /// Fails unless the range lies in the buffer.
    pub(crate) fn check(&self, range: Range<u64>, what: &str) -> Result<(), GpuError> {
        if range.start <= range.end && range.end <= self.size() {
            return Ok(());
        }
        let (buffer, what) = (self.name().to_owned(), what.to_owned());
        Err(GpuError::OutOfBounds { buffer, size: self.size(), what, start: range.start, end: range.end })
    }

    /// Fails unless the buffer was made for this use.
    pub(crate) fn require(&self, usage: BufferUsage, what: &str) -> Result<(), GpuError> {
        if self.usage().contains(usage) {
            return Ok(());
        }
        Err(self.misuse(what, "it was not made with that usage"))
    }

    fn misuse(&self, what: &str, reason: &'static str) -> GpuError {
        GpuError::BufferUsage { buffer: self.name().to_owned(), what: what.to_owned(), reason }
    }

    pub(crate) fn raw(&self) -> vk::Buffer {
        self.inner.raw.raw
    }

    /// The buffer as an array of vectors, for `what`.
    pub(crate) fn texels(&self, format: TexelFormat, what: &str) -> Result<vk::BufferView, GpuError> {
        self.inner.texels.view(self, format, what)
    }

    pub(crate) fn real_size(&self) -> u64 {
        self.inner.real_size
    }

    pub(crate) fn id(&self) -> ResourceId {
        self.inner.id
    }

    pub(crate) fn device(&self) -> &Device {
        &self.inner.device
    }
}

impl PartialEq for Buffer {
    /// Whether both are the same buffer.
    fn eq(&self, other: &Self) -> bool {
        self.inner.id == other.inner.id
    }
}

impl Eq for Buffer {}

impl std::fmt::Debug for Buffer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Buffer").field("name", &self.name()).field("size", &self.size()).finish()
    }
}

fn usage_flags(usage: BufferUsage) -> vk::BufferUsageFlags {
    let capture = vk::BufferUsageFlags::TRANSFORM_FEEDBACK_BUFFER_EXT
        | vk::BufferUsageFlags::TRANSFORM_FEEDBACK_COUNTER_BUFFER_EXT;
    let table = [
        (BufferUsage::STORAGE, vk::BufferUsageFlags::STORAGE_BUFFER),
        (BufferUsage::UNIFORM, vk::BufferUsageFlags::UNIFORM_BUFFER),
        (BufferUsage::INDEX, vk::BufferUsageFlags::INDEX_BUFFER),
        (BufferUsage::CAPTURE, capture),
        (BufferUsage::VERTEX, vk::BufferUsageFlags::VERTEX_BUFFER),
        (BufferUsage::TEXELS, vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER),
    ];
    let copies = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
    table.into_iter().filter(|(one, _)| usage.contains(*one)).fold(copies, |flags, (_, flag)| flags | flag)
}
