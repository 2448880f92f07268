//! Memory behind buffers and images.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicU64, Ordering},
};

use ash::vk;
use gpu_allocator::{
    AllocationError, AllocationSizes, MemoryLocation,
    vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc},
};

use crate::{Device, GpuError, instance::Instance, owned::RawDevice};

/// What a device has been asked for so far: to see what a frame costs, take the difference of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct MemoryUse {
    /// Buffers and images that exist.
    pub live: u64,
    /// Bytes of memory that they take.
    pub live_bytes: u64,
    /// Buffers and images made so far.
    pub made: u64,
    /// Bytes that the host has written into buffers so far.
    pub host_bytes_written: u64,
}

impl Device {
    /// What is and was asked of its memory, by all clones of the device.
    pub fn memory_use(&self) -> MemoryUse {
        self.shared.memory.counters.read()
    }
}

/// Running totals of [`MemoryUse`].
#[derive(Default)]
struct Counters {
    live: AtomicU64,
    live_bytes: AtomicU64,
    made: AtomicU64,
    host_bytes_written: AtomicU64,
}

impl Counters {
    fn read(&self) -> MemoryUse {
        let value = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        MemoryUse {
            live: value(&self.live),
            live_bytes: value(&self.live_bytes),
            made: value(&self.made),
            host_bytes_written: value(&self.host_bytes_written),
        }
    }
}

/// The allocator of a device. Field order is destruction order: the allocator frees its blocks while the device is there.
pub(crate) struct Memory {
    allocator: Mutex<Allocator>,
    max_allocation: u64,
    counters: Counters,
    _device: Arc<RawDevice>,
}

/// A piece of memory, given back on drop.
pub(crate) struct Block {
    /// Empty only during `drop`.
    allocation: Option<Allocation>,
    memory: Arc<Memory>,
}

impl Memory {
    pub(crate) fn new(
        instance: &Instance,
        device: &Arc<RawDevice>,
        physical: vk::PhysicalDevice,
        max_allocation: u64,
    ) -> Result<Arc<Self>, AllocationError> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.raw.clone(),
            device: device.raw.clone(),
            physical_device: physical,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: AllocationSizes::default(),
        })?;
        Ok(Arc::new(Self {
            allocator: Mutex::new(allocator),
            max_allocation,
            counters: Counters::default(),
            _device: Arc::clone(device),
        }))
    }

    /// Takes note of bytes that the host has written.
    pub(crate) fn count_written(&self, bytes: u64) {
        self.counters.host_bytes_written.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Takes memory; `linear` for buffers.
    pub(crate) fn allocate(
        self: &Arc<Self>,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Block, GpuError> {
        if requirements.size > self.max_allocation {
            let what = format!("memory of {name:?} in bytes");
            return Err(GpuError::Limit { what, value: requirements.size, limit: self.max_allocation });
        }
        let allocation_scheme = AllocationScheme::GpuAllocatorManaged;
        let desc = AllocationCreateDesc { name, requirements, location, linear, allocation_scheme };
        let mut allocator = self.allocator.lock().unwrap_or_else(PoisonError::into_inner);
        let allocation = allocator.allocate(&desc).map_err(|error| failure(name, requirements.size, error))?;
        drop(allocator);
        self.counters.live.fetch_add(1, Ordering::Relaxed);
        self.counters.made.fetch_add(1, Ordering::Relaxed);
        self.counters.live_bytes.fetch_add(allocation.size(), Ordering::Relaxed);
        Ok(Block { allocation: Some(allocation), memory: Arc::clone(self) })
    }
}

fn failure(name: &str, bytes: u64, error: AllocationError) -> GpuError {
    let result = match error {
        AllocationError::OutOfMemory => return GpuError::OutOfMemory { what: format!("{name:?}"), bytes },
        AllocationError::FailedToMap(_) => vk::Result::ERROR_MEMORY_MAP_FAILED,
        AllocationError::NoCompatibleMemoryTypeFound => vk::Result::ERROR_FEATURE_NOT_PRESENT,
        _ => vk::Result::ERROR_UNKNOWN,
    };
    GpuError::Vulkan { operation: format!("allocating memory for {name:?} ({error})"), result }
}

impl Block {
    /// The memory object and the offset in it, to bind an object to.
    pub(crate) fn place(&self) -> (vk::DeviceMemory, u64) {
        let Some(allocation) = &self.allocation else { return (vk::DeviceMemory::null(), 0) };
        // SAFETY: the memory object is only bound, never freed or mapped, by our callers.
        (unsafe { allocation.memory() }, allocation.offset())
    }

    /// Where the host sees the memory, if it does without flushing.
    pub(crate) fn mapped(&self) -> Option<std::ptr::NonNull<u8>> {
        let allocation = self.allocation.as_ref()?;
        let coherent = allocation.memory_properties().contains(vk::MemoryPropertyFlags::HOST_COHERENT);
        allocation.mapped_ptr().filter(|_| coherent).map(std::ptr::NonNull::cast)
    }
}

impl Drop for Block {
    fn drop(&mut self) {
        let Some(allocation) = self.allocation.take() else { return };
        self.memory.counters.live.fetch_sub(1, Ordering::Relaxed);
        self.memory.counters.live_bytes.fetch_sub(allocation.size(), Ordering::Relaxed);
        let mut allocator = self.memory.allocator.lock().unwrap_or_else(PoisonError::into_inner);
        if let Err(error) = allocator.free(allocation) {
            tracing::error!("freeing GPU memory failed: {error}");
        }
    }
}
